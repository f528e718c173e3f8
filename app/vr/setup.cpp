#include "app/vr/setup.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/mode_option.hpp"
#include "app/option_values.hpp"
#include "render/ladder.hpp"
#include "tracking/input_error.hpp"
#include "xr/frame_loop.hpp"
#include "xr/gaze_input.hpp"

namespace app {
namespace {

using render::Mode;
using tracking::Pose;

constexpr double kLeastAhead = 0.1;  // of a direction's length along the ground, to face somewhere

std::string joined(const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& file : files) {
    text += (text.empty() ? "" : " ") + file;
  }
  return text;
}

// A running map cannot take its range from the picture: colours would change with every turn of the head.
render::MapRange range_of(const VrOptions& options, Mode mode) {
  if (!options.range.empty() && mode == mode_of(options.mode)) {
    const auto v = numbers_of("--range", options.range, 2, "LO,HI, such as 0,3");
    if (!(v[0] < v[1])) {
      throw tracking::InputError("--range", "", "'" + options.range + "' must have LO below HI");
    }
    return {v[0], v[1]};
  }
  switch (mode) {
    case Mode::astigmatism:
      return {0.0, 3.0};
    case Mode::accommodation:
      return {0.0, 4.0};
    case Mode::blur:
      return {0.0, 20.0};
    default:
      return {-3.0, 3.0};
  }
}

// The turn about the vertical that the head's forehead and eyes agree on best: one that looks straight up or down faces
// where its top of the head or its chin points.
glm::dquat heading(const Pose& head) {
  glm::dvec3 ahead = head.direction({0.0, 0.0, -1.0});
  if (std::hypot(ahead.x, ahead.z) < kLeastAhead) {
    ahead = head.direction({0.0, ahead.y < 0.0 ? 1.0 : -1.0, 0.0});
  }
  return tracking::orientation_from_yaw_pitch(std::atan2(ahead.x, -ahead.z), 0.0);
}

}  // namespace

render::LiveConfig live_config(const VrOptions& options, Mode mode) {
  render::LiveConfig config;
  config.frame.mode = mode;
  config.frame.threshold_px = options.picture.threshold();
  config.frame.exposure = options.picture.exposure;
  config.frame.samples = options.samples;
  config.frame.colour_map = options.colour_map == "hsv" ? 0 : 1;
  if (render::is_map(mode)) {
    config.frame.range = range_of(options, mode);
  }
  return config;
}

ShownChoices choices_of(const VrOptions& options, const render::Scene& scene) {
  const Mode mode = mode_of(options.mode);
  return {.in_turn = 1 + options.scene.further.size(),
          .has_compared = !options.scene.compare.empty(),
          .targets = scene.targets.size(),
          .picture = render::is_map(mode) ? Mode::adof : mode,
          .first_map = mode};
}

RungChoice rung_choice(const VrOptions& options, const std::optional<SessionReplay>& replay, bool tracks_gaze) {
  if (options.picture.accuracy != kAutoAccuracy) {
    return RungChoice({*find_live_rung(options.picture.accuracy)});
  }
  if (!replay) {
    return {governed_rungs(tracks_gaze), render::GovernorConfig{}};
  }
  std::vector<render::GovernorRung> rungs;
  if (replay->record()) {
    const std::vector<NameChange>& changes = replay->record()->rungs;
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const auto rung = find_live_rung(changes[i].name);
      if (!rung) {
        throw tracking::InputError(replay->file(), "rungs[" + std::to_string(i) + "].name",
                                   "'" + changes[i].name + "' is no rung of accuracy; give --accuracy one that is");
      }
      if (std::ranges::find(rungs, rung->name, &render::GovernorRung::name) == rungs.end()) {
        rungs.push_back(*rung);
      }
    }
  }
  if (rungs.empty()) {
    rungs.push_back(*find_live_rung("standard"));
  }
  return RungChoice(std::move(rungs));
}

xr::SpaceChoice space_of(const std::string& name) {
  return name == "local_floor" ? xr::SpaceChoice::local_floor
         : name == "stage"     ? xr::SpaceChoice::stage
         : name == "local"     ? xr::SpaceChoice::local
                               : xr::SpaceChoice::automatic;
}

std::string name_of(XrReferenceSpaceType type) {
  return type == XR_REFERENCE_SPACE_TYPE_STAGE   ? "stage"
         : type == XR_REFERENCE_SPACE_TYPE_LOCAL ? "local"
                                                 : "local_floor";
}

Pose world_from_space(const SceneOptions& options, const render::Scene& scene, XrReferenceSpaceType type) {
  Pose start = start_pose(options, scene);
  const glm::dvec3 ahead = start.direction({0.0, 0.0, -1.0});
  start.orientation = tracking::orientation_from_yaw_pitch(std::atan2(ahead.x, -ahead.z), 0.0);
  if (xr::is_on_floor(type)) {
    start.position.y = 0.0;
  }
  return start;
}

Pose recentred(const SceneOptions& options, const render::Scene& scene, XrReferenceSpaceType type,
               const Pose& space_from_head) {
  const Pose start = world_from_space(options, scene, type);
  const Pose facing{glm::conjugate(heading(space_from_head)), {}};
  glm::dvec3 stands = space_from_head.position;
  if (xr::is_on_floor(type)) {
    stands.y = 0.0;
  }
  return start * facing * Pose{glm::dquat(1.0, 0.0, 0.0, 0.0), -stands};
}

std::array<int, 2> size_of_images(const VrOptions& options, const std::optional<SessionReplay>& replay,
                                  const xr::Instance& instance) {
  if (!options.size.empty()) {
    return size_of("--size", options.size);
  }
  if (replay && replay->record()) {
    return replay->record()->size;
  }
  const auto sizes = xr::recommended_sizes(instance);
  return {std::max(sizes[0][0], sizes[1][0]), std::max(sizes[0][1], sizes[1][1])};
}

double horizontal_power(const lenses::f64::Table& table, const render::EyeOptics& eye) {
  const glm::dvec3 ahead(0.0, 0.0, -1.0);
  const auto line =
      lenses::f64::trace_sight_line(table, eye.lens, eye.eye, glm::dmat3(1.0), ahead, glm::dvec2(0.0), glm::dvec2(0.0));
  if (line.status != lenses::f64::kStatusOk || eye.lens.glass.w == 0.0) {
    return 0.0;
  }
  int status = lenses::f64::kStatusOk;
  const glm::dvec3 vergence =
      lenses::f64::sight_line_vergence(lenses::f64::sight_line_transfer(eye.lens, line), 0.0, status);
  return status == lenses::f64::kStatusOk ? vergence.x : 0.0;
}

std::vector<std::pair<std::string, std::string>> recorded_options(const VrOptions& options) {
  std::vector<std::pair<std::string, std::string>> all{{"scene", options.scene.scene},
                                                       {"wearer", options.scene.wearer},
                                                       {"spectacles", options.scene.spectacles},
                                                       {"pairs", joined(options.scene.further)},
                                                       {"compare", options.scene.compare},
                                                       {"headset", options.scene.headset},
                                                       {"viewing", options.scene.viewing},
                                                       {"pose", options.scene.pose},
                                                       {"mode", options.mode},
                                                       {"accuracy", options.picture.accuracy}};
  std::erase_if(all, [](const auto& option) { return option.second.empty(); });
  return all;
}

std::vector<std::string> wanted_extensions() {
  std::vector<std::string> names = xr::gaze_extensions();
  names.emplace_back(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME);
  names.emplace_back(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME);
  return names;
}

}  // namespace app
