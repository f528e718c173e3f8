// The points of pixel and pupil that distributed rays take: evenly spread, a pixel's own, and their error told
// honestly.
#include "render/sample_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "render/sample_error.hpp"
#include "render/shaders/sample_pattern.h"

namespace {

namespace gpu = render::gpu;

// What `count` samples of one sequence take in one pixel.
std::vector<glm::vec4> points_of(glm::uvec2 pixel, int sequence, int count, std::uint32_t seed) {
  std::vector<glm::vec4> points;
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::uint32_t>(gpu::kSequences * i + sequence);
    points.push_back(gpu::sample_pattern(render::sample_point(index, seed), index, pixel, seed));
  }
  return points;
}

// How many cells of a grid of columns * rows hold a point.
std::size_t cells_met(const std::vector<glm::vec4>& points, int i, int j, int columns, int rows) {
  std::set<int> cells;
  for (const glm::vec4& p : points) {
    cells.insert(static_cast<int>(p[i] * static_cast<float>(columns)) * rows +
                 static_cast<int>(p[j] * static_cast<float>(rows)));
  }
  return cells.size();
}

// The property that makes a sequence of Sobol' points one of base 2, and that Owen's permutation keeps: 2^m points, one
// in each of the pupil's boxes of any shape with 2^m boxes, and one in each of 2^m steps of every coordinate.
TEST(SamplePattern, SpreadsEvenlyInEveryPixelAndSequence) {
  for (const glm::uvec2 pixel : {glm::uvec2(0, 0), glm::uvec2(1, 0), glm::uvec2(777, 1023), glm::uvec2(4095, 3)}) {
    for (const int sequence : {0, 1}) {
      for (const std::uint32_t seed : {0U, 1U, 0xffffffffU}) {
        const auto points = points_of(pixel, sequence, 64, seed);
        for (int columns = 1; columns <= 64; columns *= 2) {
          EXPECT_EQ(cells_met(points, 0, 1, columns, 64 / columns), 64U) << columns << " columns of the pupil";
        }
        for (const int i : {2, 3}) {
          EXPECT_EQ(cells_met(points, i, i, 64, 1), 64U) << "coordinate " << i;
        }
      }
    }
  }
}

TEST(SamplePattern, IsEachPixelsOwnWithinASharedSixteenthOfThePupil) {
  const auto index = 5U, seed = 3U;
  const glm::uvec4 digits = render::sample_point(index, seed);
  std::set<std::pair<float, float>> pupil_points;
  std::set<std::pair<int, int>> sixteenths;
  for (std::uint32_t y = 0; y < 16; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      const glm::vec4 p = gpu::sample_pattern(digits, index, {x, y}, seed);
      pupil_points.emplace(p.x, p.y);
      sixteenths.emplace(static_cast<int>(4 * p.x), static_cast<int>(4 * p.y));
    }
  }
  EXPECT_EQ(pupil_points.size(), 256U);
  EXPECT_EQ(sixteenths.size(), 1U);
}

// Neighbours and sequences are as good as independent: products of coordinates about the middle average out. The mean
// of 2^14 products of two numbers uniform on +-1/2 has a standard deviation of 1 / (12 * 128); five of them.
TEST(SamplePattern, IsUncorrelatedBetweenPixelsAndSequences) {
  const std::uint32_t seed = 9U;
  const glm::uvec4 first = render::sample_point(40, seed), second = render::sample_point(41, seed);
  glm::dvec4 with_neighbour(0.0), with_sequence(0.0);
  for (std::uint32_t y = 0; y < 128; ++y) {
    for (std::uint32_t x = 0; x < 128; ++x) {
      const auto within =
          [](const glm::vec4& p) {  // the pupil's shared sixteenth, so that only what is a pixel's own counts
            return glm::dvec4(glm::fract(4.0F * p.x), glm::fract(4.0F * p.y), p.z, p.w) - 0.5;
          };
      const glm::dvec4 here = within(gpu::sample_pattern(first, 40, {x, y}, seed));
      with_neighbour += here * within(gpu::sample_pattern(first, 40, {x + 1, y}, seed));
      with_sequence += here * within(gpu::sample_pattern(second, 41, {x, y}, seed));
    }
  }
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(with_neighbour[i] / 16384.0, 0.0, 5.0 / (12.0 * 128.0));
    EXPECT_NEAR(with_sequence[i] / 16384.0, 0.0, 5.0 / (12.0 * 128.0));
  }
}

// Equal areas of the square become equal areas of the disc; a polygon through the images of a small square's corners.
TEST(ToDisc, KeepsAreasAndEndsAtTheRim) {
  const auto area_around = [](double u, double v) {
    const double h = 1e-3;
    const auto at = [&](double du, double dv) { return glm::dvec2(gpu::to_disc({u + du, v + dv})); };
    const glm::dvec2 a = at(h, h) - at(-h, -h), b = at(-h, h) - at(h, -h);
    return 0.5 * std::abs(a.x * b.y - a.y * b.x);
  };
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0.01, 0.99);
  for (int i = 0; i < 1000; ++i) {
    const double u = uniform(engine), v = uniform(engine);
    const double x = 2 * u - 1, y = 2 * v - 1;
    if (std::abs(std::abs(x) - std::abs(y)) < 0.01) continue;  // the square lies astride a crease
    // pi of the disc to 1 of the square; single precision over 2 mm of 1 m leaves three digits.
    EXPECT_NEAR(area_around(u, v) / 4e-6, std::numbers::pi, 0.02) << u << " " << v;
  }
  for (const double along : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    EXPECT_NEAR(glm::length(gpu::to_disc({along, 0.0})), 1.0, 1e-6);
    EXPECT_NEAR(glm::length(gpu::to_disc({1.0, along})), 1.0, 1e-6);
  }
  EXPECT_EQ(gpu::to_disc({0.5, 0.5}), glm::vec2(0.0F));
}

// Two sequences whose means scatter by a known amount about the truth: the estimate is the standard deviation of their
// common mean. 20000 pixels of two numbers each: half a percent of scatter, five times that is allowed.
TEST(SampleError, IsTheStandardErrorOfTheMean) {
  std::mt19937 engine(20120507);
  for (const int samples : {32, 2, 33, 3}) {
    const int odd = samples / 2, even = samples - odd;
    std::normal_distribution<float> even_mean(0.5F, 0.1F / std::sqrt(static_cast<float>(even))),
        odd_mean(0.5F, 0.1F / std::sqrt(static_cast<float>(odd)));
    std::vector<glm::vec4> sums;
    for (int i = 0; i < 20000; ++i) {
      const float a = static_cast<float>(even) * even_mean(engine), b = static_cast<float>(odd) * odd_mean(engine);
      sums.emplace_back(a + b, a + b, a + b, a - b);
    }
    EXPECT_NEAR(render::rms_standard_error(sums, samples) * std::sqrt(samples) / 0.1, 1.0, 0.025) << samples;
  }
}

// One sample tells nothing about its error: all of the light may be wrong.
TEST(SampleError, OfOneSampleIsTheLightItself) {
  EXPECT_NEAR(render::rms_standard_error(std::vector<glm::vec4>(10, glm::vec4(0.25F)), 1), 0.25, 1e-6);
}

}  // namespace
