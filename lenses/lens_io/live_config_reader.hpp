// What a wearer file says of eyes and tracker in time: its objects "accommodation", "pupil" and "tracking".
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lenses/lens_io/json_fields.hpp"
#include "tracking/live_config.hpp"

namespace lenses::io {

[[nodiscard]] tracking::LiveConfig read_live_config(const Field& wearer);

// Adds those of the objects that differ from the defaults.
void add_live_config(nlohmann::ordered_json& wearer, const tracking::LiveConfig& config);

}  // namespace lenses::io
