// The lens's edge, in lens axes (m).
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "lenses/lens.hpp"

namespace lenses {

// The finished lens's polygon, or the blank's circle as one.
[[nodiscard]] std::vector<glm::dvec2> edge_of(const Lens& lens);

// The blank's circle as a polygon.
[[nodiscard]] std::vector<glm::dvec2> blank_of(const Lens& lens);

// Even-odd rule, for a closed polygon of any sense.
[[nodiscard]] bool inside_polygon(std::span<const glm::dvec2> polygon, const glm::dvec2& point);

}  // namespace lenses
