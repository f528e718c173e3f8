// Distance from vergence and from the scene, and its steadiness in time.
#include "tracking/fixation_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "tracking/stereo_view.hpp"

namespace {

using tracking::DepthHold;
using tracking::FixationDistance;
using tracking::Line;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kHalfPd = 0.0315;
constexpr double kNoise = 0.3 * kDegree;

std::array<Line, 2> lines_to(const glm::dvec3& point) {
  const glm::dvec3 right(kHalfPd, 0.0, 0.0), left(-kHalfPd, 0.0, 0.0);
  return {Line{right, glm::normalize(point - right)}, Line{left, glm::normalize(point - left)}};
}

TEST(VergenceEstimate, FindsThePointThatBothLinesMeet) {
  for (const double distance : {0.25, 0.4, 1.0, 6.0, 1000.0}) {
    for (const double yaw : {-30.0, 0.0, 20.0}) {
      for (const double pitch : {-35.0, 0.0, 25.0}) {
        const auto lines = lines_to(distance * tracking::direction_from_yaw_pitch(yaw * kDegree, pitch * kDegree));
        const auto estimate = tracking::vergence_estimate(lines[0], lines[1], kNoise);
        ASSERT_TRUE(estimate);
        // Of second order in half the baseline over the distance.
        const double second_order = std::pow(kHalfPd / distance, 2);
        EXPECT_NEAR(estimate->dioptres * distance, 1.0, second_order + 1e-12) << distance << " " << yaw << " " << pitch;
        const double baseline =
            2.0 * kHalfPd * std::sqrt(1.0 - std::pow(std::sin(yaw * kDegree) * std::cos(pitch * kDegree), 2));
        EXPECT_NEAR(estimate->sigma, std::numbers::sqrt2 * kNoise / baseline, 0.01 * estimate->sigma);
      }
    }
  }
}

TEST(VergenceEstimate, ParallelAndDivergingLines) {
  const Line right{{kHalfPd, 0.0, 0.0}, {0.0, 0.0, -1.0}}, left{{-kHalfPd, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  EXPECT_EQ(tracking::vergence_estimate(right, left, kNoise)->dioptres, 0.0);
  const Line outward{right.origin, tracking::direction_from_yaw_pitch(1.0 * kDegree, 0.0)};
  const Line other{left.origin, tracking::direction_from_yaw_pitch(-1.0 * kDegree, 0.0)};
  EXPECT_NEAR(tracking::vergence_estimate(outward, other, kNoise)->dioptres, -std::sin(1.0 * kDegree) / kHalfPd, 1e-12);
  // Opposite lines, lines from one point, and what is not a number have no distance.
  EXPECT_FALSE(tracking::vergence_estimate(right, {left.origin, {0.0, 0.0, 1.0}}, kNoise));
  EXPECT_FALSE(tracking::vergence_estimate(right, right, kNoise));
  EXPECT_FALSE(tracking::vergence_estimate(right, {{std::nan(""), 0.0, 0.0}, {0.0, 0.0, -1.0}}, kNoise));
}

TEST(VergenceEstimate, LinesThatPassEachOtherAreTrustedLess) {
  auto lines = lines_to({0.0, 0.0, -0.5});
  lines[0].direction = glm::normalize(lines[0].direction + glm::dvec3(0.0, 2.0 * kDegree, 0.0));
  const auto estimate = tracking::vergence_estimate(lines[0], lines[1], kNoise);
  EXPECT_NEAR(estimate->dioptres, 2.0, 0.02);
  EXPECT_NEAR(estimate->sigma, 2.0 * kDegree / (2.0 * kHalfPd), 0.01);
}

TEST(VergenceEstimate, TheStandardErrorIsWhatNoiseMakes) {
  std::mt19937_64 random(17);
  std::normal_distribution<double> noise(0.0, kNoise);
  const auto exact = lines_to({0.0, 0.0, -0.4});
  double squares = 0.0;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    auto lines = exact;
    for (Line& line : lines) line.direction = glm::normalize(line.direction + glm::dvec3(noise(random), 0.0, 0.0));
    squares += std::pow(tracking::vergence_estimate(lines[0], lines[1], kNoise)->dioptres - 2.5, 2);
  }
  const double sigma = tracking::vergence_estimate(exact[0], exact[1], kNoise)->sigma;
  EXPECT_NEAR(sigma, 0.1175, 0.0005);                             // sqrt(2) * 0.3 deg / 63 mm
  EXPECT_NEAR(std::sqrt(squares / kCount), sigma, 0.05 * sigma);  // seed 17; 1.1 % is its own standard error
}

TEST(FixationDistanceOf, TheSceneIsExactAndVergenceChooses) {
  using From = FixationDistance::From;
  const auto distance = [](const std::vector<double>& scene, std::optional<tracking::VergenceEstimate> v) {
    return tracking::fixation_distance(scene, v);
  };
  const tracking::VergenceEstimate near{2.4, 0.12}, far{-0.1, 0.12};
  EXPECT_EQ(distance({2.5}, std::nullopt).dioptres, 2.5);
  EXPECT_EQ(distance({}, std::nullopt).from, From::nothing);
  // The line's own hit while vergence agrees, what lies beside it where vergence says so.
  EXPECT_EQ(distance({2.5, 2.4}, near).dioptres, 2.5);
  EXPECT_EQ(distance({0.2, 2.5, 0.2}, near).dioptres, 2.5);
  EXPECT_EQ(distance({2.5, 0.0}, far).dioptres, 0.0);
  EXPECT_EQ(distance({2.5, 0.0}, far).from, From::scene);
  // Nothing there: the eyes look at what the scene does not hold.
  EXPECT_EQ(distance({0.2}, near).dioptres, 2.4);
  EXPECT_EQ(distance({0.2}, near).from, From::vergence);
  EXPECT_EQ(distance({2.5}, far).dioptres, 0.0);
  // A poor tracker leaves it to the scene.
  EXPECT_EQ(distance({0.2}, tracking::VergenceEstimate{2.4, 1.0}).from, From::scene);
}

TEST(DepthHold, FlickerAcrossAnEdgeIsNotFollowed) {
  DepthHold hold(0.1);
  hold.see(0.0, 2.5, false);
  for (int i = 1; i < 400; ++i) {
    EXPECT_EQ(hold.see(i / 90.0, i % 5 == 0 ? 0.25 : 2.5, false), 2.5) << i;
  }
}

TEST(DepthHold, ADepthThatLastsIsApproachedExponentially) {
  for (const double rate : {20.0, 90.0, 1000.0}) {
    DepthHold hold(0.1, 0.08);
    hold.see(-1.0, 2.5, false);
    const int dwell = static_cast<int>(std::ceil(0.1 * rate - 1e-9));
    for (int i = 0; i < rate; ++i) {
      const double value = hold.see(i / rate, 0.5, false);
      const double since = std::max(0, i - dwell) / rate;
      EXPECT_NEAR(value, 0.5 + 2.0 * std::exp(-since / 0.08), 1e-9) << rate << " Hz, frame " << i;
    }
  }
}

TEST(DepthHold, ASaccadeTakesItsDepthAlong) {
  DepthHold hold(0.1);
  hold.see(0.0, 2.5, false);
  EXPECT_EQ(hold.see(0.01, 0.2, true), 0.2);
  EXPECT_EQ(hold.see(0.02, 0.2, false), 0.2);
  // What is not a number, and time that runs back, change nothing.
  EXPECT_EQ(hold.see(0.03, std::nan(""), true), 0.2);
  EXPECT_EQ(hold.see(0.01, 3.0, true), 0.2);
  EXPECT_EQ(hold.see(std::numeric_limits<double>::infinity(), 3.0, true), 0.2);
}

}  // namespace
