// The points of which each pixel makes its own samples of pixel and pupil (shaders/sample_pattern.h).
#pragma once

#include <cstdint>

#include "render/frame_types.hpp"

namespace render {

// Sobol' point `index` in four dimensions, with the direction numbers of Joe and Kuo (Constructing Sobol sequences with
// better two-dimensional projections, 2008). Binary digits, the highest in bit 0. The first two dimensions spread any
// 2^m points from a multiple of 2^m on evenly over all 2^m boxes of one shape.
[[nodiscard]] glm::uvec4 sobol_point(std::uint32_t index);

// Of sample `index`, for all pixels: its sequence's next point, the digits permuted as seed and sequence say.
[[nodiscard]] glm::uvec4 sample_point(std::uint32_t index, std::uint32_t seed);

}  // namespace render
