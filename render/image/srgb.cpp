#include "render/image/srgb.hpp"

#include <cmath>

namespace render {

std::uint8_t srgb_encode(float linear) {
  if (!(linear > 0.0F)) return 0;
  if (linear >= 1.0F) return 255;
  const double value = linear;
  const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

float srgb_decode(std::uint8_t encoded) {
  const double value = encoded / 255.0;
  return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

}  // namespace render
