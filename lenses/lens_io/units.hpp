// Conversions between the files' units and SI. Readers and writers share them, so that a writer can look for the
// shortest text that its reader turns into the very same number.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

namespace lenses::io {

// Division by an exactly held thousand rounds once, multiplication by 1e-3 twice.
[[nodiscard]] constexpr double from_mm(double mm) {
  return mm / 1e3;
}
[[nodiscard]] constexpr double from_um(double um) {
  return um / 1e6;
}
[[nodiscard]] constexpr double from_degrees(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}
[[nodiscard]] constexpr double curvature_from_radius_mm(double radius_mm) {
  return 1e3 / radius_mm;
}

// The i-th even coefficient multiplies r^k with k = 4 + 2i: a_k in mm^(1-k) is a_k * 1000^(k-1) in m^(1-k).
[[nodiscard]] inline double even_coefficient_scale(std::size_t i) {
  return std::pow(1e3, 3.0 + 2.0 * static_cast<double>(i));
}

}  // namespace lenses::io
