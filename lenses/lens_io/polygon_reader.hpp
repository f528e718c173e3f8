#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "lenses/lens_io/json_fields.hpp"

namespace lenses::io {

// A closed polygon in lens axes, [[x, y], ...] in mm, of 3 to `most` points that enclose an area; metres out.
[[nodiscard]] std::vector<glm::dvec2> read_polygon(const Field& polygon, std::size_t most);

}  // namespace lenses::io
