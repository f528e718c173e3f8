#include "render/sample_error.hpp"

#include <algorithm>
#include <cmath>

namespace render {

double rms_standard_error(std::span<const glm::vec4> sums, int samples) {
  const int odd = samples / 2;
  const int even = samples - odd;
  const double n = samples;
  // The variance of a mean of n is that of means of `even` and `odd`, which differ by d: E d^2 n_e n_o / n^2.
  const double weight = odd > 0 ? std::sqrt(static_cast<double>(even) * static_cast<double>(odd)) / n : 1.0;
  double total = 0.0;
  for (const glm::vec4& s : sums) {
    const double sum = 0.2126 * s.x + 0.7152 * s.y + 0.0722 * s.z;
    const double difference = 0.5 * (sum + s.w) / even - (odd > 0 ? 0.5 * (sum - s.w) / odd : 0.0);
    total += difference * difference;
  }
  return weight * std::sqrt(total / static_cast<double>(std::max<std::size_t>(sums.size(), 1)));
}

}  // namespace render
