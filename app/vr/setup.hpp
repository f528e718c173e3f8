// From the options of `vergence vr` to what its session is made with.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/recording/session_replay.hpp"
#include "app/vr/options.hpp"
#include "app/vr/rungs.hpp"
#include "app/vr/shown.hpp"
#include "render/live_frame.hpp"
#include "xr/spaces.hpp"

namespace app {

// Of a picture of this mode; sizes, eyes, pairs, accuracy and the guard band are for later.
[[nodiscard]] render::LiveConfig live_config(const VrOptions& options, render::Mode mode);

// A map that --mode asks for lies over the picture of approximate defocus.
[[nodiscard]] ShownChoices choices_of(const VrOptions& options, const render::Scene& scene);

// --accuracy: a rung's name, or auto: a governor's rungs, those of the recording, or standard for a plain trace. Throws
// tracking::InputError for a recording with rungs that there are not.
[[nodiscard]] RungChoice rung_choice(const VrOptions& options, const std::optional<SessionReplay>& replay,
                                     bool tracks_gaze);

[[nodiscard]] xr::SpaceChoice space_of(const std::string& name);
[[nodiscard]] std::string name_of(XrReferenceSpaceType type);

// The scene's camera is where a wearer starts: the runtime's floor is the scene's, and its centre lies below the
// camera. A space without a floor has its origin where the head was, so that is put at the camera.
[[nodiscard]] tracking::Pose world_from_space(const SceneOptions& options, const render::Scene& scene,
                                              XrReferenceSpaceType type);
// The same once the wearer has asked to be put there anew, from where the head is now: its place and where it faces are
// the start's, its pitch and roll stay; on a floor the scene's floor stays the room's.
[[nodiscard]] tracking::Pose recentred(const SceneOptions& options, const render::Scene& scene,
                                       XrReferenceSpaceType type, const tracking::Pose& space_from_head);

// One size for both eyes: as asked for, else that of the recording, else the larger of what is recommended for each.
[[nodiscard]] std::array<int, 2> size_of_images(const VrOptions& options, const std::optional<SessionReplay>& replay,
                                                const xr::Instance& instance);

// Of the lens straight ahead (D): what it adds to the wavefront from afar; 0 for none.
[[nodiscard]] double horizontal_power(const lenses::f64::Table& table, const render::EyeOptics& eye);

// What a picture depends on, as it was asked for.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> recorded_options(const VrOptions& options);

[[nodiscard]] std::vector<std::string> wanted_extensions();

}  // namespace app
