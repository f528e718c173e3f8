// Powers as matrices, and in the words of a prescription. A power matrix is (hh, hv, vv) in dioptres over the wearer's
// horizontal and vertical; angles of a prescription are in TABO (ISO 8429, as the examiner sees them), radians.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "lenses/lens.hpp"

namespace lenses {

enum class CylinderForm { minus, plus };

// The axis lies in (0, pi], as ISO 8429 writes it: 180 degrees, never 0. Where there is no cylinder it is 180 degrees.
[[nodiscard]] Refraction sphere_cylinder(const glm::dvec3& power, CylinderForm form);

[[nodiscard]] glm::dvec3 power_matrix(const Refraction& refraction);

// The vector towards the base in the wearer's axes, prism dioptres: prisms add as vectors.
[[nodiscard]] glm::dvec2 prism_vector(std::span<const Prism> prisms);

// The base lies in [0, 2 pi).
[[nodiscard]] Prism to_prism(const glm::dvec2& vector);

[[nodiscard]] constexpr double mean_power(const glm::dvec3& power) {
  return 0.5 * (power.x + power.z);
}
[[nodiscard]] double astigmatism(const glm::dvec3& power);  // >= 0

}  // namespace lenses
