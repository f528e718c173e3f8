// The session in the headset from beginning to end.
#pragma once

#include "app/vr/connection.hpp"
#include "app/vr/options.hpp"
#include "app/vr/report.hpp"

namespace app {

// Throws tracking::InputError for what files and options hold, before the headset is asked for anything; xr::Error and
// render::vk::DeviceError for what fails then. more_controls: see VrConnection.
[[nodiscard]] VrReport run_vr(const VrOptions& options, const ControlSource& more_controls = {});

}  // namespace app
