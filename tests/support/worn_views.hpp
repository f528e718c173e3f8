// A wearer with both eyes open in a scene, as views for the renderer, and the light path of one pixel in double
// precision, written from the definition of a picture's axes.
#pragma once

#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lenses/lens_io/lens_io.hpp"
#include "lenses/trace.hpp"
#include "render/fixation.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

namespace support {

namespace f64 = lenses::f64;
using render::Viewing;

inline constexpr double kDegree = 0.017453292519943295;

// Two eyes behind two lenses (or none) on a head somewhere in the world.
struct WornPair {
  lenses::LensModel model;
  std::array<std::size_t, 2> lens{};
  std::array<render::EyeOptics, 2> eyes;  // indexed by Side
  tracking::Pose world_from_head;
};

inline WornPair wear(const lenses::Wearer& wearer, const lenses::Spectacles* spectacles,
                     const tracking::Pose& world_from_head) {
  WornPair pair;
  pair.world_from_head = world_from_head;
  for (const std::size_t i : {0U, 1U}) {
    const lenses::Eye& eye = wearer.eye[i];
    pair.lens[i] = lenses::append_lens(pair.model, spectacles != nullptr ? &spectacles->lens[i] : nullptr,
                                       static_cast<lenses::Side>(i), eye.entrance_pupil_depth);
    const double amplitude = eye.accommodation_amplitude.value_or(lenses::accommodation_amplitude_at(wearer.age));
    const double offset = (i == 0 ? 1.0 : -1.0) * wearer.pupillary_distance[i];
    pair.eyes[i] = {pair.model.lens[pair.lens[i]],
                    lenses::make_eye_data(eye, amplitude, eye.pupil_diameter.value_or(lenses::kDefaultPupilDiameter)),
                    world_from_head * tracking::Pose{glm::dquat(1.0, 0.0, 0.0, 0.0), {offset, 0.0, 0.0}}};
  }
  return pair;
}

// The view of one eye that looks along `gaze` (head axes), its picture centred there.
inline render::ViewSetup view_along(const WornPair& pair, std::size_t side, Viewing viewing, const glm::dvec3& gaze,
                                    const tracking::FieldOfView& fov) {
  render::ViewSetup view;
  view.lens = pair.lens[side];
  view.eye = pair.eyes[side].eye;
  view.world_from_eye = pair.eyes[side].world_from_eye;
  view.viewing = viewing;
  view.view.gaze = glm::normalize(gaze);
  view.view.fov = fov;
  view.view.head_from_view.orientation = glm::quat_cast(tracking::listing_rotation(view.view.gaze));
  return view;
}

// Right and left eye on one point of the world; in gaze viewing with the one accommodation state that follows.
inline std::vector<render::ViewSetup> views_at(const WornPair& pair, Viewing viewing, const glm::dvec3& target,
                                               const tracking::FieldOfView& fov) {
  const double distance = glm::length(target - pair.world_from_head.position);
  const auto fixation = render::fixate(f64::Table{pair.model.table}, pair.eyes, viewing, target, distance);
  std::vector<render::ViewSetup> views;
  for (const std::size_t i : {0U, 1U}) {
    views.push_back(view_along(pair, i, viewing, fixation.line[i].gaze, fov));
    if (viewing == Viewing::gaze) {
      views.back().accommodation = fixation.accommodation[i];
    }
  }
  return views;
}

inline glm::dvec3 target_position(const render::Scene& scene, const std::string& name) {
  for (const render::Target& target : scene.targets) {
    if (target.name == name) {
      return target.position;
    }
  }
  throw std::invalid_argument("no target " + name);
}

inline render::Scene reading_room() {
  return render::read_gltf(VERGENCE_BUILT_ASSETS "/reading_room.glb");
}

// The direction from the pupil, in primary axes, of the centre of pixel (x, y).
inline glm::dvec3 pixel_direction(const render::ViewSetup& view, int x, int y, int width, int height) {
  const tracking::FieldOfView& fov = view.view.fov;
  const double right = -fov.tan_left + (fov.tan_left + fov.tan_right) * (x + 0.5) / width;
  const double up = fov.tan_up - (fov.tan_up + fov.tan_down) * (y + 0.5) / height;
  const glm::dvec3 ahead = view.view.head_from_view.orientation * glm::dvec3(right, up, -1.0);
  if (!view.virtual_image) {
    return glm::normalize(ahead);
  }
  // A headset's pixel is a point of its virtual image.
  const glm::dvec3 point = glm::dvec3(0.0, 0.0, view.virtual_image->origin_behind_pupil) +
                           view.virtual_image->distance * glm::normalize(ahead);
  const glm::dmat3 turn = f64::eye_turn(static_cast<int>(view.viewing), view.view.gaze, glm::normalize(ahead));
  return glm::normalize(point - f64::turned_pupil(turn, view.eye.pupil.y));
}

// What the double-precision tracer makes of a direction from the pupil.
struct ReferencePixel {
  int status = f64::kStatusOk;
  glm::dvec3 start, direction;  // of the ray into the scene, world
  f64::TraceInput ray;
};

inline ReferencePixel reference_pixel(const WornPair& pair, const render::ViewSetup& view,
                                      const glm::dvec3& direction) {
  ReferencePixel pixel;
  pixel.ray = {glm::dvec4(direction, 0.0), glm::dvec4(view.view.gaze, 0.0),
               glm::ivec4(0, 0, static_cast<int>(view.viewing), 0)};
  const glm::dmat3 turn = f64::eye_turn(static_cast<int>(view.viewing), view.view.gaze, direction);
  const auto line = f64::trace_sight_line(f64::Table{pair.model.table}, pair.model.lens[view.lens], view.eye, turn,
                                          direction, glm::dvec2(0.0), glm::dvec2(0.0));
  pixel.status = line.status;
  const bool through = line.status == f64::kStatusOk;
  pixel.start = view.world_from_eye.point(through ? line.start : line.pupil);
  pixel.direction = view.world_from_eye.direction(through ? line.direction_object : direction);
  return pixel;
}

}  // namespace support
