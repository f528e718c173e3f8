// From the options of `vergence vr` to what its session is made with.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/recording/session_replay.hpp"
#include "app/vr/options.hpp"
#include "render/live_frame.hpp"
#include "xr/spaces.hpp"

namespace app {

// Sizes, eyes, pairs and the guard band are for later.
[[nodiscard]] render::LiveConfig live_config(const VrOptions& options);

[[nodiscard]] xr::SpaceChoice space_of(const std::string& name);
[[nodiscard]] std::string name_of(XrReferenceSpaceType type);

// The scene's camera is where a wearer starts: the runtime's floor is the scene's, and its centre lies below the
// camera. A space without a floor has its origin where the head was, so that is put at the camera.
[[nodiscard]] tracking::Pose world_from_space(const SceneOptions& options, const render::Scene& scene,
                                              XrReferenceSpaceType type);

// One size for both eyes: as asked for, else that of the recording, else the larger of what is recommended for each.
[[nodiscard]] std::array<int, 2> size_of_images(const VrOptions& options, const std::optional<SessionReplay>& replay,
                                                const xr::Instance& instance);

// Of the lens straight ahead (D): what it adds to the wavefront from afar; 0 for none.
[[nodiscard]] double horizontal_power(const lenses::f64::Table& table, const render::EyeOptics& eye);

// What a picture depends on, as it was asked for.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> recorded_options(const VrOptions& options);

[[nodiscard]] std::vector<std::string> wanted_extensions();

}  // namespace app
