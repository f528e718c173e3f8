// The distance between two linear pictures as a display shows them.
#pragma once

#include <cstdint>
#include <span>

#include "render/image/image.hpp"

namespace render {

// Linear values, any number of channels interleaved alike, each times `exposure` (a factor), clamped to 0..1 and encoded
// with sRGB's transfer function, but not rounded: differences are fractions of full scale. Where `counted` is not empty
// it has one entry for each `channels` values, and those with 0 are left out. Spans that do not fit each other throw
// std::invalid_argument; nothing counted gives equality.
[[nodiscard]] Comparison compare_shown(std::span<const float> linear, std::span<const float> reference,
                                       double exposure, std::span<const std::uint8_t> counted = {}, int channels = 3);

}  // namespace render
