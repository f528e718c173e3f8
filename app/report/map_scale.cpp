#include "app/report/map_scale.hpp"

#include <algorithm>
#include <cmath>

namespace app {

MapScale map_scale(std::vector<double> values, double least_step) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  MapScale scale{0.0, 4.0 * least_step, least_step};
  if (values.empty()) {
    return scale;
  }
  std::ranges::sort(values);
  const std::size_t off = values.size() / 200;
  const double low = values[off], high = values[values.size() - 1 - off];
  constexpr double kMost = 24.0, kDigits = 1e-9;  // lines; of a value, in which a step still shows
  const double needed = std::max((high - low) / kMost, kDigits * std::max(std::abs(low), std::abs(high)));
  for (double decade = least_step; scale.step < needed; decade *= 10.0) {
    for (const double factor : {1.0, 2.0, 4.0}) {
      scale.step = std::max(scale.step, scale.step < needed ? factor * decade : 0.0);
    }
  }
  constexpr double kSlack = 1e-6;  // of a step: a value on a line is not beyond it
  scale.low = std::floor(low / scale.step + kSlack) * scale.step;
  scale.high = std::ceil(high / scale.step - kSlack) * scale.step;
  while (scale.high - scale.low < 3.5 * scale.step) {
    scale.high += scale.step;
    scale.low -= low >= 0.0 && scale.low - scale.step < -0.5 * scale.step ? 0.0 : scale.step;
  }
  return scale;
}

}  // namespace app
