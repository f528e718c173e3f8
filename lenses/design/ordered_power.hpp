// A prescription as the numbers a lens is computed from: a 2x2 power matrix over the wearer's horizontal and vertical
// (x right, y up), and a prism vector towards the base; and back. TABO angles mirror: the wearer's is 180 - TABO.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <span>

#include "lenses/prescription.hpp"

namespace lenses::design {

// What a lens does at one point: power (D) and prism (prism dioptres, towards the base).
struct PointPower {
  glm::dmat2 power{0.0};
  glm::dvec2 prism{0.0};
};

[[nodiscard]] glm::dmat2 power_matrix(double sphere, double cylinder, double axis_tabo);
[[nodiscard]] glm::dvec2 prism_vector(std::span<const Prism> prisms);
[[nodiscard]] PointPower ordered_power(const Prescription& prescription);

// The same in a prescription's words. The cylinder takes the sign asked for; its axis is in (0, pi] (ISO 8429 writes
// 180 degrees, not 0). Cylinder and prism of a magnitude that no instrument shows (1e-9) are left out.
[[nodiscard]] Prescription to_prescription(const PointPower& power, bool plus_cylinder, double addition = 0.0);

// Of a thin lens that sends the same wavefront from `distance` metres farther along the light: F (I - d F)^-1.
[[nodiscard]] glm::dmat2 nearer_to_eye(const glm::dmat2& power, double distance);

// Eigenvalues of a symmetric matrix, `first` the algebraically larger, and the direction of `first` from +x.
struct Meridians {
  double first = 0.0, second = 0.0, axis = 0.0;
};
[[nodiscard]] Meridians meridians(const glm::dmat2& symmetric);

// c_along in the direction `axis`, c_across at right angles to it.
[[nodiscard]] glm::dmat2 from_meridians(double along, double across, double axis);

}  // namespace lenses::design
