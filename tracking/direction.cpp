#include "tracking/direction.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace tracking {

std::optional<glm::dvec3> unit_direction(const glm::dvec3& direction) {
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!std::isfinite(direction.x + direction.y + direction.z) || !std::isfinite(largest) || !(largest > 0.0)) {
    return std::nullopt;
  }
  // A power of two first, which is exact, so that squares neither overflow nor vanish.
  const int exponent = std::ilogb(largest);
  return glm::normalize(glm::dvec3(std::scalbn(direction.x, -exponent), std::scalbn(direction.y, -exponent),
                                   std::scalbn(direction.z, -exponent)));
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

glm::dvec3 turned_towards(const glm::dvec3& from, const glm::dvec3& to, double fraction) {
  const glm::dvec3 across = to - glm::dot(from, to) * from;
  const double length = glm::length(across);
  if (!(length > 1e-12)) {
    return glm::dot(from, to) > 0.0 || fraction >= 0.5 ? to : from;
  }
  const double angle = fraction * angle_between(from, to);
  return glm::normalize(std::cos(angle) * from + std::sin(angle) / length * across);
}

}  // namespace tracking
