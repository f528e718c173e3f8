#include "lenses/measure/power.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "lenses/engine.hpp"

namespace lenses {
namespace {

using std::numbers::pi;

constexpr double kRound = 1e-9;  // D or prism dioptres; below it an axis or a base is rounding

// From counter-clockwise as the wearer sees it to TABO, in (0, pi].
double tabo_axis(double ours) {
  const double axis = std::fmod(pi - ours, pi);
  return axis > 0.0 ? axis : axis + pi;
}

}  // namespace

Refraction sphere_cylinder(const glm::dvec3& power, CylinderForm form) {
  const glm::dvec3 k = f64::principal(power);  // larger, smaller, meridian of the larger
  const bool round = k.x - k.y < kRound;
  // The axis is the meridian in which the cylinder does nothing: that of the sphere.
  return form == CylinderForm::minus ? Refraction{k.x, k.y - k.x, round ? pi : tabo_axis(k.z)}
                                     : Refraction{k.y, k.x - k.y, round ? pi : tabo_axis(k.z + 0.5 * pi)};
}

glm::dvec3 power_matrix(const Refraction& refraction) {
  const double ours = pi - refraction.axis;
  const double c = std::cos(ours), s = std::sin(ours);
  const double along = refraction.sphere, across = refraction.sphere + refraction.cylinder;
  return {along * c * c + across * s * s, (along - across) * c * s, along * s * s + across * c * c};
}

glm::dvec2 prism_vector(std::span<const Prism> prisms) {
  glm::dvec2 sum(0.0);
  for (const Prism& prism : prisms) {
    sum += prism.magnitude * glm::dvec2(-std::cos(prism.base), std::sin(prism.base));
  }
  return sum;
}

Prism to_prism(const glm::dvec2& vector) {
  const double magnitude = glm::length(vector);
  if (magnitude < kRound) {
    return {magnitude, 0.0};
  }
  const double base = std::atan2(vector.y, -vector.x);
  return {magnitude, base < 0.0 ? base + 2.0 * pi : base + 0.0};
}

double astigmatism(const glm::dvec3& power) {
  const glm::dvec3 k = f64::principal(power);
  return k.x - k.y;
}

}  // namespace lenses
