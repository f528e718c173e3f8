// Closed polygons in the lens plane.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>

namespace lenses {

// By the even-odd rule.
[[nodiscard]] bool is_inside(std::span<const glm::dvec2> polygon, const glm::dvec2& point);

// A point where two sides that are not neighbours meet.
[[nodiscard]] std::optional<glm::dvec2> self_crossing(std::span<const glm::dvec2> polygon);

}  // namespace lenses
