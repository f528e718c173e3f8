// Which point of the pixel and of the pupil a sample takes; one text for C++ and GLSL.
//
// Samples take turns in two sequences of Sobol' points (render/sample_point.hpp), whose digits each pixel permutes
// anew, nested (Owen, Randomly permuted (t,m,s)-nets and (t,s)-sequences, 1995): every pixel has points of its own with
// the net's even spread, and the two sequences are independent, so that their difference tells the error. Both eyes
// have the same: the pattern depends on the pixel alone.
//
// The highest digits of the pupil's coordinates are permuted alike in all pixels. The rays of one sample then pass the
// same sixteenth of the pupil and find the scene together; once each pixel has had all sixteen, it makes no difference
// in what order.
#ifndef VERGENCE_RENDER_SAMPLE_PATTERN_H
#define VERGENCE_RENDER_SAMPLE_PATTERN_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/integer.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#define VERGENCE_PATTERN_FUNCTION inline
namespace render::gpu {
using uint = std::uint32_t;
using glm::abs, glm::bitfieldReverse, glm::cos, glm::sin;
using glm::uvec2, glm::uvec4, glm::vec2, glm::vec4;
#else
#define VERGENCE_PATTERN_FUNCTION
#endif

const int kSequences = 2;
const uint kSharedDigits = 3u;  // mask of the pupil's digits that all pixels share, the highest digit in bit 0
const int kEvenSamples = 32;    // in so many both sequences reach each part of the pupil once

// A mix of bits after Wang: every bit of x reaches every bit of the result.
VERGENCE_PATTERN_FUNCTION uint mixed(uint x) {
  x = (x ^ 61u) ^ (x >> 16);
  x *= 9u;
  x ^= x >> 4;
  x *= 0x27d4eb2du;
  return x ^ (x >> 15);
}

// Owen's nested permutation of binary digits, the highest in bit 0: whether a digit is turned over depends on the seed
// and on the digits above it. By products and sums, which carry upwards alone (Laine and Karras, Stratified sampling
// for stochastic transparency, 2011; constants: Vegdahl 2021).
VERGENCE_PATTERN_FUNCTION uint permuted_digits(uint x, uint seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// Digits, the highest in bit 0, as a number from 0 up to 1.
VERGENCE_PATTERN_FUNCTION float number_of(uint digits) {
  return float(bitfieldReverse(digits) >> 8) / 16777216.0f;
}

// xy: the pupil's point in the unit square, zw: the pixel's. digits: sample_point() of the sample's index.
VERGENCE_PATTERN_FUNCTION vec4 sample_pattern(uvec4 digits, uint index, uvec2 pixel, uint seed) {
  uint h = mixed(mixed(pixel.x + 65536u * pixel.y) + seed * 0x9e3779b9u + (index & 1u));
  uint x = permuted_digits(digits.x, h);
  uint y = permuted_digits(digits.y, mixed(h + 1u));
  uint z = permuted_digits(digits.z, mixed(h + 2u));
  uint w = permuted_digits(digits.w, mixed(h + 3u));
  x = (digits.x & kSharedDigits) | (x & ~kSharedDigits);
  y = (digits.y & kSharedDigits) | (y & ~kSharedDigits);
  return vec4(number_of(x), number_of(y), number_of(z), number_of(w));
}

// Area-preserving map of the unit square to the unit disc (Shirley and Chiu 1997).
VERGENCE_PATTERN_FUNCTION vec2 to_disc(vec2 square) {
  vec2 c = 2.0f * square - 1.0f;
  if (c.x == 0.0f && c.y == 0.0f) {
    return vec2(0.0f, 0.0f);
  }
  bool wide = abs(c.x) > abs(c.y);
  float radius = wide ? c.x : c.y;
  float angle = wide ? 0.7853981633974483f * c.y / c.x : 1.5707963267948966f - 0.7853981633974483f * c.x / c.y;
  return radius * vec2(cos(angle), sin(angle));
}

#ifdef __cplusplus
}  // namespace render::gpu
#endif
#endif
