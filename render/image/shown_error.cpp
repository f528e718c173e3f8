#include "render/image/shown_error.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace render {
namespace {

double shown(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

}  // namespace

Comparison compare_shown(std::span<const float> linear, std::span<const float> reference, double exposure,
                         std::span<const std::uint8_t> counted, int channels) {
  if (channels <= 0 || linear.size() != reference.size() ||
      (!counted.empty() && counted.size() * static_cast<std::size_t>(channels) != linear.size())) {
    throw std::invalid_argument("only pictures of one size can be compared");
  }
  Comparison result;
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < linear.size(); ++i) {
    if (!counted.empty() && counted[i / static_cast<std::size_t>(channels)] == 0) {
      continue;
    }
    const double difference =
        shown(exposure * static_cast<double>(linear[i])) - shown(exposure * static_cast<double>(reference[i]));
    squares += difference * difference;
    result.max_abs = std::max(result.max_abs, std::abs(difference));
    ++count;
  }
  result.rmse = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(count, 1)));
  result.psnr_db = -20.0 * std::log10(result.rmse);
  return result;
}

}  // namespace render
