// The lens's edge and the parts of its area, in lens axes (m).
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "lenses/lens.hpp"

namespace lenses {

// The finished lens's polygon, or the blank's circle as one.
[[nodiscard]] std::vector<glm::dvec2> edge_of(const Lens& lens);

// The blank's circle as a polygon.
[[nodiscard]] std::vector<glm::dvec2> blank_of(const Lens& lens);

// Which side of the segments' edges two points of the back and the front lie: power is continuous only where this
// number is.
[[nodiscard]] int zone_of(const Lens& lens, const glm::dvec2& back_point, const glm::dvec2& front_point);

}  // namespace lenses
