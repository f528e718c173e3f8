// The transfer function of sRGB (IEC 61966-2-1), between linear light and 8-bit display values.
#pragma once

#include <cstdint>

namespace render {

// Clamped to 0..1, rounded to the nearest step; NaN gives 0.
[[nodiscard]] std::uint8_t srgb_encode(float linear);

[[nodiscard]] float srgb_decode(std::uint8_t encoded);

}  // namespace render
