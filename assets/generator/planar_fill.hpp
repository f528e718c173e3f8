// Fills closed contours with triangles, by the nonzero winding rule: contours may overlap (their union is filled) and
// the other sense of turning makes holes. The plane is cut into horizontal slabs at every corner and every crossing;
// inside a slab no two edges cross, so each inside span is a trapezoid, and spans between the same two edges join.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace assets {

using Contour = std::vector<glm::dvec2>;

struct FlatShape {
  std::vector<glm::dvec2> points;
  std::vector<std::uint32_t> indices;  // counter-clockwise triangles
};

[[nodiscard]] FlatShape fill(std::span<const Contour> contours);

}  // namespace assets
