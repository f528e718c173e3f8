#include "app/render_setup.hpp"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <stdexcept>

#include "app/option_values.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "lenses/pupil.hpp"
#include "lenses/trace.hpp"
#include "render/scene/framing.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using render::Viewing;
using tracking::InputError;
using tracking::Pose;
using tracking::Side;

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kLargestGaze_deg = 45.0;
constexpr double kNearestTarget_m = 0.02;  // spectacles and eye lie within

glm::dvec3 gaze_direction(const SceneOptions& options) {
  const auto v = numbers_of("--gaze", options.gaze, 2, "YAW,PITCH in degrees, such as 10,-25");
  for (const double angle : v) {
    check_range("--gaze", angle, -kLargestGaze_deg, kLargestGaze_deg, "deg");
  }
  return tracking::direction_from_yaw_pitch(v[0] * kRadians, v[1] * kRadians);
}

const render::Target& find_target(const std::string& name, const render::Scene& scene) {
  std::string known;
  for (const render::Target& target : scene.targets) {
    if (target.name == name) {
      return target;
    }
    known += (known.empty() ? "" : ", ") + target.name;
  }
  throw InputError(
      "--look-at", "",
      "'" + name + "' is not a target of the scene; " + (known.empty() ? "it has none" : "it has " + known));
}

// By its name, or its number from 0 on; nothing where the text is five numbers.
std::optional<Pose> pose_of_camera(const std::string& text, const render::Scene& scene) {
  std::string known;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const render::Camera& camera = scene.cameras[i];
    const std::string number = std::to_string(i);
    if (text == camera.name || text == number) {
      return camera.pose;
    }
    known += (known.empty() ? "" : ", ") + (camera.name.empty() ? number : camera.name);
  }
  if (text.find(',') == std::string::npos) {
    throw InputError("--pose", "",
                     "'" + text + "' is not a camera of the scene; " +
                         (known.empty() ? "it has none" : "it has " + known) +
                         ", and X,Y,Z,YAW,PITCH in metres and degrees is allowed");
  }
  return std::nullopt;
}

lenses::f64::EyeData eye_of(const lenses::Wearer& wearer, std::size_t side,
                            const std::optional<lenses::HeadsetDisplay>& headset) {
  const lenses::Eye& eye = wearer.eye[side];
  const double amplitude = eye.accommodation_amplitude.value_or(lenses::accommodation_amplitude_at(wearer.age));
  double pupil = lenses::kDefaultPupilDiameter;
  if (headset) {
    pupil = lenses::pupil_diameter_in_light(headset->luminance, kHeadsetField_deg2, true, wearer.age);
  }
  return lenses::make_eye_data(eye, amplitude, eye.pupil_diameter.value_or(pupil));
}

// The wearer behind one pair (nullopt: no spectacles), not yet looking anywhere.
WornPair wear(RenderSetup& setup, const std::optional<lenses::Spectacles>& spectacles, const std::string& file,
              const Pose& world_from_head, const std::optional<lenses::HeadsetDisplay>& headset) {
  WornPair pair;
  pair.name = !spectacles ? "no spectacles" : spectacles->name.empty() ? file : spectacles->name;
  if (spectacles) {
    pair.tint = spectacles->tint_transmission;
  }
  for (const Side side : {Side::right, Side::left}) {
    const auto i = static_cast<std::size_t>(side);
    const lenses::Lens* lens = spectacles ? &spectacles->lens[i] : nullptr;
    try {
      pair.lens[i] = lenses::append_lens(setup.lenses, lens, side, setup.wearer.eye[i].entrance_pupil_depth);
    } catch (const std::invalid_argument& error) {
      throw InputError(file, side == Side::right ? "right" : "left", error.what());
    }
    const double offset = (side == Side::right ? 1.0 : -1.0) * setup.wearer.pupillary_distance[i];
    pair.eyes[i] = {setup.lenses.lens[pair.lens[i]], eye_of(setup.wearer, i, headset),
                    world_from_head * Pose{glm::dquat(1.0, 0.0, 0.0, 0.0), {offset, 0.0, 0.0}}};
  }
  return pair;
}

std::optional<lenses::Spectacles> read_pair(const std::string& file) {
  if (file == "none") {
    return std::nullopt;
  }
  return lenses::read_spectacles(file);
}

std::vector<std::string> pair_files(const SceneOptions& options) {
  std::vector<std::string> files{options.spectacles};
  files.insert(files.end(), options.further.begin(), options.further.end());
  if (!options.compare.empty()) {
    files.push_back(options.compare);
  }
  if (options.bare_too) {
    files.emplace_back("none");
  }
  return files;
}

void look(WornPair& pair, const RenderSetup& setup, const SceneOptions& options, const render::Scene& scene,
          const render::RayQuery& query, const Pose& world_from_head) {
  const lenses::f64::Table table{setup.lenses.table};
  if (!options.look_at.empty()) {
    const glm::dvec3 target = find_target(options.look_at, scene).position;
    for (const render::EyeOptics& eye : pair.eyes) {
      if (!(glm::length(target - eye.world_from_eye.position) >= kNearestTarget_m)) {
        throw InputError("--look-at", "", "'" + options.look_at + "' lies within 20 mm of a pupil; move --pose away");
      }
    }
    const double distance = glm::length(target - world_from_head.position);
    pair.fixation = render::fixate(table, pair.eyes, setup.viewing, target, distance);
    return;
  }
  const glm::dvec3 gaze = gaze_direction(options);
  pair.fixation = setup.viewing == Viewing::gaze ? render::fixate_along(table, pair.eyes, setup.viewing, gaze, query)
                                                 : render::look_parallel(table, pair.eyes, setup.viewing, gaze, query);
}

render::ViewSetup view_of(const RenderSetup& setup, const WornPair& pair, Side side, double fov_deg,
                          const std::optional<lenses::HeadsetDisplay>& headset) {
  const auto i = static_cast<std::size_t>(side);
  render::ViewSetup view;
  view.lens = pair.lens[i];
  view.eye = pair.eyes[i].eye;
  view.world_from_eye = pair.eyes[i].world_from_eye;
  view.view.gaze = pair.fixation.line[i].gaze;
  view.view.head_from_view.orientation = glm::quat_cast(tracking::listing_rotation(view.view.gaze));
  view.view.fov =
      tracking::FieldOfView::symmetric(fov_deg * kRadians, static_cast<double>(setup.size[0]) / setup.size[1]);
  view.viewing = setup.viewing;
  if (setup.viewing == Viewing::gaze) {
    view.accommodation = pair.fixation.accommodation[i];
  }
  view.tint = pair.tint;
  if (headset) {
    const bool at_pupil = headset->view_origin == lenses::HeadsetDisplay::ViewOrigin::pupil;
    view.virtual_image = render::VirtualImage{headset->focal_distance, at_pupil ? 0.0 : view.eye.pupil.y};
  }
  return view;
}

}  // namespace

Pose start_pose(const SceneOptions& options, const render::Scene& scene) {
  if (options.pose.empty()) {
    return scene.cameras.empty() ? render::framing_pose(scene) : scene.cameras.front().pose;
  }
  if (const std::optional<Pose> camera = pose_of_camera(options.pose, scene)) {
    return *camera;
  }
  const auto v = numbers_of("--pose", options.pose, 5, "X,Y,Z,YAW,PITCH in metres and degrees, such as 0,1.2,0,-10,0");
  for (int i = 0; i < 3; ++i) {
    check_range("--pose", v[static_cast<std::size_t>(i)], -1e5, 1e5, "m");
  }
  check_range("--pose", v[3], -360.0, 360.0, "deg of yaw");
  check_range("--pose", v[4], -90.0, 90.0, "deg of pitch");
  return {tracking::orientation_from_yaw_pitch(v[3] * kRadians, v[4] * kRadians), {v[0], v[1], v[2]}};
}

Viewing viewing_of(const std::string& name) {
  return name == "fixed" ? Viewing::fixed : name == "scanning" ? Viewing::scanning : Viewing::gaze;
}

RenderSetup make_render_setup(const SceneOptions& options, const render::Scene& scene) {
  RenderSetup setup;
  if (!options.wearer.empty()) {
    setup.wearer = lenses::read_wearer(options.wearer);
  }
  std::optional<lenses::HeadsetDisplay>& headset = setup.headset;
  if (!options.headset.empty()) {
    headset = lenses::read_headset(options.headset);
  } else if (options.in_headset) {
    headset = lenses::HeadsetDisplay{};
  }
  check_range("--fov", options.fov_deg, 1.0, 170.0, "deg");
  setup.size = size_of("--size", options.size);
  setup.viewing = viewing_of(options.viewing);
  // A picture for two eyes is laid out as they see it: the left eye's on the left.
  if (options.eye != "right") {
    setup.sides.push_back(Side::left);
  }
  if (options.eye != "left") {
    setup.sides.push_back(Side::right);
  }
  const Pose world_from_head = start_pose(options, scene);
  for (const std::string& file : pair_files(options)) {
    setup.pairs.push_back(wear(setup, read_pair(file), file, world_from_head, headset));
  }
  const render::RayQuery query(scene);
  for (WornPair& pair : setup.pairs) {
    look(pair, setup, options, scene, query, world_from_head);
    for (const Side side : setup.sides) {
      setup.views.push_back(view_of(setup, pair, side, options.fov_deg, headset));
    }
  }
  return setup;
}

}  // namespace app
