#include "render/sample_point.hpp"

#include <array>

#include "render/shaders/sample_pattern.h"

namespace render {
namespace {

constexpr std::size_t kDigits = 32;

// A primitive polynomial's inner coefficients and the first direction numbers m.
struct Dimension {
  std::size_t degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 3> first;
};

constexpr std::array<Dimension, 3> kDimensions{{{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}}};

// By digit of the index, the highest digit in the highest bit. Bratley and Fox, Algorithm 659 (1988):
// v_k = a_1 v_(k-1) ^ ... ^ v_(k-s) ^ (v_(k-s) >> s).
std::array<std::uint32_t, kDigits> directions_of(const Dimension& d) {
  std::array<std::uint32_t, kDigits> v{};
  for (std::size_t k = 0; k < kDigits; ++k) {
    if (k < d.degree) {
      v[k] = d.first[k] << (kDigits - 1 - k);
      continue;
    }
    v[k] = v[k - d.degree] ^ (v[k - d.degree] >> d.degree);
    for (std::size_t j = 1; j < d.degree; ++j) {
      v[k] ^= ((d.coefficients >> (d.degree - 1 - j)) & 1U) * v[k - j];
    }
  }
  return v;
}

}  // namespace

glm::uvec4 sobol_point(std::uint32_t index) {
  static const std::array kDirections{directions_of(kDimensions[0]), directions_of(kDimensions[1]),
                                      directions_of(kDimensions[2])};
  glm::uvec3 sum(0);
  for (std::size_t k = 0; k < kDigits; ++k) {
    if (((index >> k) & 1U) != 0U) {
      sum ^= glm::uvec3(kDirections[0][k], kDirections[1][k], kDirections[2][k]);
    }
  }
  return {index, glm::bitfieldReverse(sum)};  // the first is van der Corput's: the index itself, turned round
}

glm::uvec4 sample_point(std::uint32_t index, std::uint32_t seed) {
  glm::uvec4 point = sobol_point(index / gpu::kSequences);
  for (int i = 0; i < 4; ++i) {
    const std::uint32_t stream = 4U * (index % gpu::kSequences) + static_cast<std::uint32_t>(i);
    point[i] = gpu::permuted_digits(point[i], gpu::mixed(gpu::mixed(seed) + stream));
  }
  return point;
}

}  // namespace render
