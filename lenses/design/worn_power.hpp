// What the eye gets through a worn lens from an object at infinity.
#pragma once

#include <optional>

#include "lenses/design/ordered_power.hpp"
#include "lenses/lens.hpp"

namespace lenses::design {

struct WornSetup {
  Side side = Side::right;
  double entrance_pupil_depth = Eye{}.entrance_pupil_depth;
  double centre_of_rotation_depth = Eye{}.centre_of_rotation_depth;
  // Powers are those of a thin lens this far before the cornea, across the eye's line of sight: on the vertex sphere
  // where it equals the lens's own vertex distance.
  double reference_vertex = 0.013;
};

// The eye turned about its centre so that its line of sight meets the back surface at `point` (lens axes). A lens on
// the eye is looked through straight ahead. None where the line does not pass.
[[nodiscard]] std::optional<PointPower> worn_power(const Lens& lens, const WornSetup& setup, const glm::dvec2& point);

// The same for a direction of the line of sight in primary-gaze axes (unit).
[[nodiscard]] std::optional<PointPower> worn_power_along(const Lens& lens, const WornSetup& setup,
                                                         const glm::dvec3& gaze);

}  // namespace lenses::design
