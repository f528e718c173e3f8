// FLIP against what follows from its definition by hand, and the laws that it must obey.
#include "render/image/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using render::flip;
using render::Image8;

constexpr double kDegree_px = 22.0;

Image8 constant(int width, int height, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  Image8 image = render::black_image(width, height);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    image.rgb[i] = r;
    image.rgb[i + 1] = g;
    image.rgb[i + 2] = b;
  }
  return image;
}

Image8 noise(std::uint32_t seed, int width, int height) {
  std::mt19937 random(seed);
  Image8 image = render::black_image(width, height);
  for (std::uint8_t& value : image.rgb) {
    value = static_cast<std::uint8_t>(random() & 255U);
  }
  return image;
}

// A sharp bar in the middle, blurred by a box of 2 r + 1 pixels.
Image8 blurred_bar(int r) {
  Image8 image = render::black_image(64, 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      double sum = 0.0;
      for (int k = -r; k <= r; ++k) {
        sum += x + k >= 28 && x + k < 36 ? 1.0 : 0.0;
      }
      const auto value = static_cast<std::uint8_t>(std::lround(255.0 * sum / (2 * r + 1)));
      for (std::size_t c = 0; c < 3; ++c) {
        image.rgb[3 * static_cast<std::size_t>(y * 64 + x) + c] = value;
      }
    }
  }
  return image;
}

TEST(Flip, EqualImagesDifferNowhere) {
  const Image8 image = noise(1, 37, 21);
  const auto result = flip(image, image, kDegree_px);
  EXPECT_EQ(result.mean, 0.0);
  EXPECT_EQ(result.map.size(), 37U * 21U);
  EXPECT_TRUE(std::ranges::all_of(result.map, [](float v) { return v == 0.0F; }));
}

// Constant images have no features, and filters do not change them: only the colours count. White and black are 100
// apart in lightness and 0 in chroma. Green against blue, the largest difference there is, by CIELAB of sRGB's
// primaries (L 87.73, a -86.18, b 83.18; L 32.30, a 79.19, b -107.86) and the Hunt factor L/100: lightness 55.43 and
// chroma hypot(-75.61 - 25.58, 72.98 + 34.84) = 147.87, together 203.30. With q = 0.7: 25.12 of 41.24; the knee at 0.4
// of it is 16.50; 0.95 + 0.05 (25.12 - 16.50) / (41.24 - 16.50) = 0.9674.
TEST(Flip, WhiteAgainstBlackIsTheDefinitionsNumber) {
  const auto result = flip(constant(40, 30, 255, 255, 255), constant(40, 30, 0, 0, 0), kDegree_px);
  EXPECT_NEAR(result.mean, 0.9674, 2e-4);  // of the four digits above
  const auto [low, high] = std::ranges::minmax(result.map);
  EXPECT_NEAR(low, high, 1e-6) << "the same everywhere";
}

// Mid grey 128 is 53.585 in lightness; against 118 (L 49.637) the difference is 3.948, below the knee:
// 0.95 * 3.948^0.7 / 16.496 = 0.1506.
TEST(Flip, SmallDifferencesLieBelowTheKnee) {
  const auto result = flip(constant(20, 20, 128, 128, 128), constant(20, 20, 118, 118, 118), kDegree_px);
  EXPECT_NEAR(result.mean, 0.1506, 5e-4);  // lightness by hand has five digits
}

TEST(Flip, GreenAgainstBlueIsTheLargest) {
  EXPECT_NEAR(flip(constant(9, 9, 0, 255, 0), constant(9, 9, 0, 0, 255), kDegree_px).mean, 1.0, 1e-6);
}

TEST(Flip, DoesNotCareWhichComesFirst) {
  const Image8 a = noise(2, 33, 18), b = noise(3, 33, 18);
  const auto one = flip(a, b, kDegree_px), other = flip(b, a, kDegree_px);
  EXPECT_EQ(one.map, other.map);
}

TEST(Flip, GrowsWithBlurAndStaysWithinOne) {
  const Image8 sharp = blurred_bar(0);
  double last = 0.0;
  for (const int r : {1, 2, 4, 7}) {
    const auto result = flip(blurred_bar(r), sharp, kDegree_px);
    EXPECT_GT(result.mean, last) << "box of " << 2 * r + 1;
    EXPECT_LE(*std::ranges::max_element(result.map), 1.0F);
    last = result.mean;
  }
}

// Fine noise that the eye cannot resolve averages out: the more pixels in a degree, the less is seen.
TEST(Flip, UnresolvedNoiseVanishes) {
  Image8 checks = constant(64, 64, 118, 118, 118);
  for (std::size_t i = 0; i < checks.rgb.size(); ++i) {
    const std::size_t x = i / 3 % 64, y = i / 3 / 64;
    checks.rgb[i] = (x + y) % 2 == 0 ? 128 : 107;  // their linear mean is 118's within a third of a step
  }
  const Image8 grey = constant(64, 64, 118, 118, 118);
  const double coarse = flip(checks, grey, 5.0).mean, fine = flip(checks, grey, 100.0).mean;
  EXPECT_LT(fine, 0.25 * coarse);
}

TEST(Flip, TakesAnySizeAndRefusesWhatCannotBe) {
  const Image8 dot = noise(4, 1, 1), other = noise(5, 1, 1);
  for (const double degree_px : {0.01, 1.0, 1000.0}) {
    const double mean = flip(dot, other, degree_px).mean;
    EXPECT_TRUE(mean >= 0.0 && mean <= 1.0) << degree_px;
  }
  EXPECT_THROW((void)flip(dot, noise(4, 2, 1), kDegree_px), std::invalid_argument);
  EXPECT_THROW((void)flip(dot, other, 0.0), std::invalid_argument);
  EXPECT_THROW((void)flip(dot, other, NAN), std::invalid_argument);
}

}  // namespace
