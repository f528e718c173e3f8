// The filter of gaze directions against the low pass it is, and the sphere's own arithmetic.
#include "tracking/direction_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "tracking/direction.hpp"
#include "tracking/stereo_view.hpp"

namespace {

using tracking::DirectionFilter;

constexpr double kDegree = std::numbers::pi / 180.0;

glm::dvec3 at_yaw(double degrees) {
  return tracking::direction_from_yaw_pitch(degrees * kDegree, 0.0);
}
double yaw_of(const glm::dvec3& d) {
  return std::atan2(d.x, -d.z) / kDegree;
}

// Settled at 0, then a step to 10 degrees at t = 0 seen at these times; the value at 0.3 s.
double after_step(const std::vector<double>& times) {
  DirectionFilter filter({.rest_cutoff = 0.8, .speed_slope = 0.0});
  for (int i = -400; i <= 0; ++i) filter.see(0.01 * i, at_yaw(0.0));
  for (const double t : times) filter.see(t, at_yaw(10.0));
  return yaw_of(*filter.value());
}

TEST(DirectionFilter, AtRestItIsALowPassWhateverTheSteps) {
  // The step counts from the last sample before it, as samples stand for the time up to them.
  const double expected = 10.0 * (1.0 - std::exp(-2.0 * std::numbers::pi * 0.8 * 0.3));
  for (const int count : {6, 27, 36, 100}) {
    std::vector<double> times;
    for (int i = 1; i <= count; ++i) times.push_back(0.3 * i / count);
    EXPECT_NEAR(after_step(times), expected, 1e-9) << count;
  }
  EXPECT_NEAR(after_step({0.004, 0.05, 0.051, 0.1, 0.149, 0.18, 0.22, 0.26, 0.3}), expected, 1e-9);
}

TEST(DirectionFilter, ItStepsAlongGreatCircles) {
  DirectionFilter filter({.rest_cutoff = 1.0, .speed_slope = 0.0});
  const glm::dvec3 a = tracking::direction_from_yaw_pitch(0.3, 0.5), b = tracking::direction_from_yaw_pitch(-0.2, -0.4);
  for (int i = 0; i < 200; ++i) filter.see(0.01 * i, a);
  for (int i = 200; i < 260; ++i) {
    const glm::dvec3 value = filter.see(0.01 * i, b);
    EXPECT_NEAR(glm::length(value), 1.0, 1e-15);
    EXPECT_NEAR(glm::dot(value, glm::normalize(glm::cross(a, b))), 0.0, 1e-14);
  }
}

// A ramp of speed v lags by v / (2 pi cutoff), with the cutoff that the speed calls for.
TEST(DirectionFilter, SpeedRaisesTheCutoff) {
  const double step = 1e-3;
  for (const double speed : {5.0, 20.0, 60.0}) {
    DirectionFilter filter({.rest_cutoff = 0.5, .speed_slope = 4.0, .speed_cutoff = 1.0});
    double lag = 0.0;
    for (int i = 0; i < 3000; ++i) {
      const double truth = speed * step * i;
      lag = truth - yaw_of(filter.see(step * i, at_yaw(truth)));
    }
    // 2 %: the speed as a vector turns with the gaze while it is filtered, and steps are 1 ms.
    const double expected = speed / (2.0 * std::numbers::pi * (0.5 + 4.0 * speed * kDegree));
    EXPECT_NEAR(lag, expected, 0.02 * expected + speed * step) << speed << " deg/s";
  }
}

TEST(DirectionFilter, AfterARestartItAverages) {
  DirectionFilter filter({.rest_cutoff = 0.01, .speed_slope = 0.0});
  filter.see(0.0, at_yaw(30.0));
  filter.restart();
  double sum = 0.0;
  for (int i = 1; i <= 20; ++i) {
    const double yaw = (i * 7) % 5 - 2.0;
    sum += yaw;
    EXPECT_NEAR(yaw_of(filter.see(0.01 * i, at_yaw(yaw))), sum / i, 1e-9) << i;
  }
}

TEST(DirectionFilter, TimesThatDoNotIncreaseChangeNothing) {
  DirectionFilter filter;
  filter.see(1.0, at_yaw(0.0));
  filter.see(1.1, at_yaw(1.0));
  const glm::dvec3 before = *filter.value();
  EXPECT_EQ(filter.see(1.1, at_yaw(20.0)), before);
  EXPECT_EQ(filter.see(0.5, at_yaw(20.0)), before);
  EXPECT_EQ(filter.see(std::numeric_limits<double>::quiet_NaN(), at_yaw(20.0)), before);
}

TEST(Direction, UnitOfAnyLengthButNone) {
  for (const double scale : {1e-300, 1e-3, 1.0, 1e300}) {
    const auto unit = tracking::unit_direction(scale * glm::dvec3(3.0, -4.0, 12.0));
    ASSERT_TRUE(unit) << scale;
    EXPECT_LE(glm::length(*unit - glm::dvec3(3.0, -4.0, 12.0) / 13.0), 1e-15);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(tracking::unit_direction({0.0, 0.0, 0.0}));
  EXPECT_FALSE(tracking::unit_direction({nan, 0.0, 1.0}));
  EXPECT_FALSE(tracking::unit_direction({0.0, inf, 1.0}));
  EXPECT_FALSE(tracking::unit_direction({inf, -inf, 1.0}));
}

TEST(Direction, TurnsByAFractionOfTheAngle) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 a = *tracking::unit_direction({unit(random), unit(random), unit(random)});
    const glm::dvec3 b = *tracking::unit_direction({unit(random), unit(random), unit(random)});
    const double fraction = 0.5 * (1.0 + unit(random));
    const glm::dvec3 c = tracking::turned_towards(a, b, fraction);
    EXPECT_NEAR(tracking::angle_between(a, c), fraction * tracking::angle_between(a, b), 1e-12);
    EXPECT_NEAR(tracking::angle_between(c, b), (1.0 - fraction) * tracking::angle_between(a, b), 1e-12);
  }
  const glm::dvec3 ahead(0.0, 0.0, -1.0);
  EXPECT_EQ(tracking::turned_towards(ahead, ahead, 0.3), ahead);
  EXPECT_EQ(tracking::turned_towards(ahead, -ahead, 0.3), ahead);
  EXPECT_NEAR(tracking::angle_between(ahead, {1e-9, 0.0, -1.0}), 1e-9, 1e-18);
}

}  // namespace
