#include "lenses/measure/worn_map.hpp"

#include <algorithm>
#include <cmath>

#include "lenses/measure/zone.hpp"

namespace lenses {
namespace {

constexpr double kDegrees = std::numbers::pi / 180.0;

f64::SurfacePoint back_at(const LensModel& model, const glm::dvec2& point) {
  return f64::surface_point(f64::Table{model.table}, model.lens.front().back, point);
}

// Twice continuously differentiable from 0 at 0 to 1 at 1.
double smooth_step(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return x * x * x * (10.0 - x * (15.0 - 6.0 * x));
}

}  // namespace

WornLens::WornLens(const Lens& lens, Side side, const Eye& eye)
    : eye_(make_eye_data(eye, 0.0, 0.0)), pupil_to_sphere_(lens.fit.vertex_distance + eye.entrance_pupil_depth) {
  append_lens(model_, &lens, side, eye.entrance_pupil_depth);
}

WornReading WornLens::read(const glm::dvec3& gaze, double object_vergence) const {
  WornReading reading;
  const f64::LensData& lens = model_.lens.front();
  const glm::dvec2 centre(0.0);
  const f64::SightLine line =
      f64::trace_sight_line(f64::Table{model_.table}, lens, eye_, f64::listing_rotation(gaze), gaze, centre, centre);
  reading.status = static_cast<RayStatus>(line.status);
  if (reading.status != RayStatus::ok) {
    return reading;
  }
  reading.back_point = glm::dvec2(line.path.back_hit);
  reading.front_point = glm::dvec2(line.path.front_hit);
  reading.zone = zone_of(model_, reading.back_point, reading.front_point);
  // From the vertex sphere instead of the pupil: a focus in the pupil is then no special case.
  f64::RayTransfer m = f64::sight_line_transfer(lens, line);
  m.b -= pupil_to_sphere_ * m.a;
  m.d -= pupil_to_sphere_ * m.c;
  const double beyond_front =
      object_vergence > 0.0 ? 1.0 / object_vergence + pupil_to_sphere_ - line.path.t_back - line.path.t_front : 1.0;
  if (!(beyond_front > 0.0)) {
    reading.status = RayStatus::singular;
    return reading;
  }
  int status = f64::kStatusOk;
  const glm::dvec3 vergence = f64::sight_line_vergence(m, object_vergence > 0.0 ? 1.0 / beyond_front : 0.0, status);
  reading.status = static_cast<RayStatus>(status);
  reading.power = vergence + glm::dvec3(object_vergence, 0.0, object_vergence);
  const glm::dvec3& out = line.direction_object;
  reading.prism = 100.0 / dot(out, gaze) * glm::dvec2(dot(out, line.e_h), dot(out, line.e_v));
  return reading;
}

glm::dvec3 WornLens::gaze_through(const glm::dvec2& point) const {
  const f64::LensData& lens = model_.lens.front();
  const glm::dvec3 place = f64::from_lens_point(lens, glm::dvec3(point, back_at(model_, point).z));
  return glm::normalize(place - glm::dvec3(0.0, 0.0, eye_.pupil.y));
}

glm::dvec3 WornLens::gaze_through_front(const glm::dvec2& point) const {
  // From back to front a line of sight moves aside by little, and about as much for all around it.
  constexpr int kSteps = 12;
  glm::dvec2 back = point;
  for (int i = 0; i < kSteps; ++i) {
    const WornReading reading = read(gaze_through(back), 0.0);
    if (reading.status != RayStatus::ok) {
      return gaze_through(point);
    }
    back += point - reading.front_point;
  }
  return gaze_through(back);
}

glm::dvec2 gaze_angles(const glm::dvec3& gaze) {
  return {std::atan2(gaze.x, -gaze.z), std::asin(std::clamp(gaze.y, -1.0, 1.0))};
}

glm::dvec3 gaze_direction(const glm::dvec2& angles) {
  const double level = std::cos(angles.y);
  return {std::sin(angles.x) * level, std::sin(angles.y), -std::cos(angles.x) * level};
}

WornMap worn_map(const Lens& lens, Side side, const Eye& eye, const WornMapConfig& config, const Progress& progress) {
  constexpr double kNearBelow = 30.0 * kDegrees, kLeastBelow = 1.0 * kDegrees;
  const WornLens worn(lens, side, eye);
  const ReferencePoints& points = lens.reference_points;
  WornMap map{square_grid(config.half_field, config.points), 0.0, 0.0, {}};
  map.far_pitch = points.fitting_cross ? gaze_angles(worn.gaze_through(*points.fitting_cross)).y : 0.0;
  map.near_pitch = points.near ? gaze_angles(worn.gaze_through(*points.near)).y : map.far_pitch - kNearBelow;
  if (!(map.near_pitch < map.far_pitch - kLeastBelow)) {
    map.near_pitch = map.far_pitch - kNearBelow;
  }
  map.readings.reserve(map.grid.count());
  for (std::size_t i = 0; i < map.grid.count(); ++i) {
    const glm::dvec2 angles = map.grid.at(i);
    const glm::dvec3 gaze = gaze_direction(angles);
    WornMapReading reading;
    reading.far = worn.read(gaze, 0.0);
    reading.object_vergence =
        smooth_step((map.far_pitch - angles.y) / (map.far_pitch - map.near_pitch)) / config.working_distance;
    reading.working = worn.read(gaze, reading.object_vergence);
    map.readings.push_back(reading);
    if (progress && i % map.grid.columns == 0) {
      progress(static_cast<double>(i) / static_cast<double>(map.grid.count()));
    }
  }
  return map;
}

}  // namespace lenses
