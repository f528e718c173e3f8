#include "lenses/design/ordered_power.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace lenses::design {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnseen = 1e-9;  // D or prism dioptres

// The other way of counting of the same angle: TABO to the wearer's and back.
double mirrored(double angle) {
  return kPi - angle;
}

// The cosine of a right angle is 0.
double without_noise(double cosine) {
  return std::abs(cosine) < 1e-15 ? 0.0 : cosine;
}

// Folded into (0, period].
double folded(double angle, double period) {
  const double rest = angle - period * std::floor(angle / period);
  return rest > 0.0 ? rest : period;
}

}  // namespace

glm::dmat2 from_meridians(double along, double across, double axis) {
  const glm::dvec2 a(std::cos(axis), std::sin(axis));
  const glm::dvec2 b(-a.y, a.x);
  return along * glm::outerProduct(a, a) + across * glm::outerProduct(b, b);
}

Meridians meridians(const glm::dmat2& m) {
  const double mean = 0.5 * (m[0][0] + m[1][1]);
  const double difference = 0.5 * (m[0][0] - m[1][1]);
  const double cross = 0.5 * (m[0][1] + m[1][0]);
  const double half = std::hypot(difference, cross);
  return {mean + half, mean - half, half > 0.0 ? 0.5 * std::atan2(cross, difference) : 0.0};
}

glm::dmat2 power_matrix(double sphere, double cylinder, double axis_tabo) {
  return from_meridians(sphere, sphere + cylinder, mirrored(axis_tabo));
}

glm::dvec2 prism_vector(std::span<const Prism> prisms) {
  glm::dvec2 sum(0.0);
  for (const Prism& prism : prisms) {
    const double base = mirrored(prism.base);
    sum += prism.magnitude * glm::dvec2(without_noise(std::cos(base)), without_noise(std::sin(base)));
  }
  return sum;
}

PointPower ordered_power(const Prescription& p) {
  return {power_matrix(p.sphere, p.cylinder, p.axis), prism_vector(p.prism)};
}

Prescription to_prescription(const PointPower& power, bool plus_cylinder, double addition) {
  Prescription result;
  result.addition = addition;
  const Meridians m = meridians(power.power);
  const double astigmatism = m.first - m.second;
  if (astigmatism < kUnseen) {
    result.sphere = 0.5 * (m.first + m.second);
  } else {
    // The axis of a cylinder is the meridian in which it has no power: that of the sphere.
    result.sphere = plus_cylinder ? m.second : m.first;
    result.cylinder = plus_cylinder ? astigmatism : -astigmatism;
    result.axis = folded(mirrored(plus_cylinder ? m.axis + 0.5 * kPi : m.axis), kPi);
  }
  if (const double size = glm::length(power.prism); size >= kUnseen) {
    const double base = folded(mirrored(std::atan2(power.prism.y, power.prism.x)), 2.0 * kPi);
    result.prism.push_back({size, base < 2.0 * kPi ? base : 0.0});
  }
  return result;
}

glm::dmat2 nearer_to_eye(const glm::dmat2& power, double distance) {
  return power * glm::inverse(glm::dmat2(1.0) - distance * power);
}

}  // namespace lenses::design
