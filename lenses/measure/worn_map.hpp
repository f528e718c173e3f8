// A lens as the turning eye meets it: for each gaze the power along the line of sight, which passes through the eye's
// centre of rotation, at the vertex sphere (ISO 13666: about the centre of rotation, through the back vertex).
#pragma once

#include <numbers>
#include <vector>

#include "lenses/lens.hpp"
#include "lenses/lens_model.hpp"
#include "lenses/measure/grid.hpp"
#include "lenses/measure/lens_map.hpp"
#include "lenses/trace_result.hpp"

namespace lenses {

struct WornReading {
  RayStatus status = RayStatus::miss_back;  // nothing but it means anything unless it is ok
  // What the lens adds to the object's vergence at the vertex sphere: hh, hv, vv in D, in the turned eye's basis.
  glm::dvec3 power{0.0};
  // Deviation of the line of sight by the lens, 100 tan(angle), towards the base; right and up of the turned eye.
  glm::dvec2 prism{0.0};
  glm::dvec2 back_point{0.0}, front_point{0.0};  // m, lens axes
  int zone = 0;                                  // see zone_of
};

class WornLens {
 public:
  // Throws std::invalid_argument for a lens that cannot be modelled (see append_lens).
  WornLens(const Lens& lens, Side side, const Eye& eye);

  // gaze: unit, primary-gaze axes. object_vergence: 1 over the distance from the vertex sphere to the object along the
  // line of sight, 1/m; 0 is infinity. An object within the lens has status singular.
  [[nodiscard]] WornReading read(const glm::dvec3& gaze, double object_vergence) const;

  // The gaze whose line of sight meets the back surface at a point of the lens (lens axes, m). Of a lens that turns
  // with the eye: the one from the centre of rotation in primary gaze.
  [[nodiscard]] glm::dvec3 gaze_through(const glm::dvec2& point) const;

  // The same for a point of the front surface; where no line of sight reaches it, of the back surface below it.
  [[nodiscard]] glm::dvec3 gaze_through_front(const glm::dvec2& point) const;

 private:
  LensModel model_;
  f64::EyeData eye_;
  double pupil_to_sphere_;  // m
};

// Yaw to the wearer's right and pitch up, radians, of a unit direction, and back.
[[nodiscard]] glm::dvec2 gaze_angles(const glm::dvec3& gaze);
[[nodiscard]] glm::dvec3 gaze_direction(const glm::dvec2& angles);

struct WornMapConfig {
  double half_field = 40.0 * std::numbers::pi / 180.0;  // of yaw and pitch, radians
  std::size_t points = 81;                              // each way
  double working_distance = 0.4;                        // of the near gaze, m from the vertex sphere
};

struct WornMapReading {
  WornReading far;               // object at infinity
  double object_vergence = 0.0;  // 1/m, of this gaze's working distance
  WornReading working;
};

struct WornMap {
  Grid grid;                // yaw, pitch
  double far_pitch = 0.0;   // from here up the working distance is infinite
  double near_pitch = 0.0;  // from here down it is that of the near gaze; its vergence changes smoothly between
  std::vector<WornMapReading> readings;
};

// The far gaze is through the fitting cross (straight ahead without one), the near gaze through the near point (30
// degrees further down without one).
[[nodiscard]] WornMap worn_map(const Lens& lens, Side side, const Eye& eye, const WornMapConfig& config,
                               const Progress& progress = {});

}  // namespace lenses
