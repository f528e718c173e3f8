#include "render/map_range.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace render {
namespace {

double map_value(Mode mode, const glm::vec4& v, const glm::vec4& more) {
  switch (mode) {
    case Mode::power:
      return 0.5 * (v.x + v.z);
    case Mode::astigmatism:
      return std::hypot(v.x - v.z, 2.0F * v.y);
    case Mode::accommodation:
      return v.w;
    default:
      return more.x * map_unit_factor(mode);
  }
}

}  // namespace

bool is_map(Mode mode) {
  return mode >= Mode::power;
}

double map_unit_factor(Mode mode) {
  return mode == Mode::blur ? 60.0 * 180.0 / std::numbers::pi : 1.0;
}

MapRange map_range_of(Mode mode, const std::vector<glm::vec4>& wavefronts) {
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < wavefronts.size(); i += 2) {
    if (wavefronts[i + 1].y >= 0.0F) {
      values.push_back(map_value(mode, wavefronts[i], wavefronts[i + 1]));
    }
  }
  if (values.empty()) {
    return {0.0, 1.0};
  }
  const auto percentile = [&](double p) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
  };
  const double low = std::floor(4.0 * percentile(0.01)) / 4.0;
  const double high = std::ceil(4.0 * percentile(0.99)) / 4.0;
  return {low, high > low ? high : low + 0.25};
}

}  // namespace render
