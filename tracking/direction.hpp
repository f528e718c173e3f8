// Directions as points of the unit sphere.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace tracking {

// Unit length, or nothing where the vector is not finite or has no direction. Very long and very short ones do.
[[nodiscard]] std::optional<glm::dvec3> unit_direction(const glm::dvec3& direction);

// Radians, exact near 0 and pi too. Both unit.
[[nodiscard]] double angle_between(const glm::dvec3& a, const glm::dvec3& b);

// `from` turned towards `to` by a fraction of the angle between them. Both unit; opposite ones have no way between
// them, and the nearer end is taken.
[[nodiscard]] glm::dvec3 turned_towards(const glm::dvec3& from, const glm::dvec3& to, double fraction);

}  // namespace tracking
