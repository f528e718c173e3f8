// What the eye gets through a worn lens from an object at infinity.
#pragma once

#include <optional>

#include "lenses/design/lens_shape.hpp"
#include "lenses/design/ordered_power.hpp"
#include "lenses/lens.hpp"
#include "lenses/lens_model.hpp"

namespace lenses::design {

struct WornSetup {
  Side side = Side::right;
  double entrance_pupil_depth = Eye{}.entrance_pupil_depth;
  double centre_of_rotation_depth = Eye{}.centre_of_rotation_depth;
  // Powers are those of a thin lens this far before the cornea, across the eye's line of sight: on the vertex sphere
  // where it equals the lens's own vertex distance.
  double reference_vertex = 0.013;
};

// A lens before an eye that turns about its centre.
class WornLens {
 public:
  WornLens(const Lens& lens, const WornSetup& setup);

  // The line of sight that meets the back surface at `point` (lens axes, m). A lens on the eye is looked through
  // straight ahead. None where the line does not pass.
  [[nodiscard]] std::optional<PointPower> through(const glm::dvec2& point) const;

  // The line of sight in this direction (primary-gaze axes, unit).
  [[nodiscard]] std::optional<PointPower> along(const glm::dvec3& gaze) const;

 private:
  WornSetup setup_;
  Lens::AttachedTo attached_to_;
  PlacedSurface back_;
  LensModel model_;
};

[[nodiscard]] inline std::optional<PointPower> worn_power(const Lens& lens, const WornSetup& setup,
                                                          const glm::dvec2& point) {
  return WornLens(lens, setup).through(point);
}

[[nodiscard]] inline std::optional<PointPower> worn_power_along(const Lens& lens, const WornSetup& setup,
                                                                const glm::dvec3& gaze) {
  return WornLens(lens, setup).along(gaze);
}

}  // namespace lenses::design
