// Accommodation and pupil in time against their closed forms, at any frame rate.
#include "tracking/accommodation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tracking/pupil_response.hpp"

namespace {

using tracking::Accommodation;
using tracking::AccommodationConfig;
using tracking::DelayedResponse;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();
constexpr std::array<double, 2> kYoung{10.0, 10.0};

std::array<double, 2> both(double demand) {
  return {demand, demand};
}

TEST(Accommodation, AStepIsLatencyAndExponential) {
  const AccommodationConfig config;
  const double from = tracking::settled_response(config, 0.25), to = tracking::settled_response(config, 2.5);
  for (const double rate : {20.0, 72.0, 90.0, 1000.0}) {
    Accommodation eye(config, kYoung);
    EXPECT_EQ(eye.step(-1.0, both(0.25))[0], from);
    for (int i = 0; i <= 2 * rate; ++i) {
      const double time = i / rate;
      const double value = eye.step(time, both(2.5))[0];
      const double since = time - config.latency;
      const double expected = since <= 0.0 ? from : to + (from - to) * std::exp(-since / config.time_constant);
      EXPECT_NEAR(value, expected, 1e-12) << rate << " Hz, " << time << " s";
    }
  }
  // Known figures: 63.2 % of the way 0.25 s after the latency, 95 % after 0.75 s.
  EXPECT_NEAR(from, 0.3, 1e-12);
  EXPECT_NEAR(to, 2.325, 1e-12);
}

// Demands that hold from one change to the next, seen by frames at the changes and any others between.
TEST(Accommodation, TheStateDoesNotDependOnTheFrames) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto demand_at = [](int change) { return (change * 7 % 11) * 0.4; };
  const auto run = [&](double step) {
    Accommodation eye(AccommodationConfig{}, kYoung);
    std::array<double, 2> state{};
    for (int change = 0; change < 40; ++change) {
      const double begin = 0.2 * change, end = begin + 0.2;
      for (double t = begin; t<end - 1e-9; t += step> 0.0 ? step : 0.05 * unit(random) + 1e-3) {
        state = eye.step(t, both(demand_at(change)));
      }
    }
    return eye.step(8.0, both(0.0))[1];
  };
  const double reference = run(0.2);
  for (const double step : {1.0 / 20.0, 1.0 / 72.0, 1.0 / 90.0, 1e-3, 0.0, 0.0}) {
    EXPECT_NEAR(run(step), reference, 1e-12) << step << ", seed 23";
  }
}

TEST(Accommodation, SettlesOnTheStimulusResponseLine) {
  const AccommodationConfig config{.slope = 0.9, .tonic = 0.75};
  for (const auto& [demand, response] :
       std::vector<std::pair<double, double>>{{0.0, 0.075}, {0.75, 0.75}, {2.5, 2.325}, {5.0, 4.575}, {-2.0, 0.0}}) {
    EXPECT_NEAR(tracking::settled_response(config, demand), response, 1e-12);
    Accommodation eye(config, kYoung);
    eye.step(0.0, both(1.5));
    // 20 time constants.
    for (int i = 0; i < 10; ++i) eye.step(0.6 * i, both(demand));
    EXPECT_NEAR(eye.state()[0], response, 1e-8);
  }
  // An ideal eye by its parameters.
  EXPECT_EQ(tracking::settled_response({.slope = 1.0, .tonic = 0.0}, 3.3), 3.3);
}

TEST(Accommodation, WithinTheDepthOfFocusNothingIsAnswered) {
  Accommodation eye(AccommodationConfig{.depth_of_focus = 0.3}, kYoung);
  const double rest = eye.step(0.0, both(2.0))[0];
  for (int i = 1; i < 200; ++i) {
    EXPECT_EQ(eye.step(0.01 * i, both(2.0 + 0.29 * ((i % 3) - 1)))[0], rest);
  }
  eye.step(2.0, both(2.31));
  EXPECT_NEAR(eye.step(20.0, both(2.31))[0], tracking::settled_response({}, 2.31), 1e-12);
}

TEST(Accommodation, OneDriveForBothEyes) {
  // The lesser demand counts, each eye follows as far as it can, and no farther drive is stored up.
  Accommodation eye(AccommodationConfig{.slope = 1.0, .tonic = 0.0, .depth_of_focus = 0.0}, {1.0, 4.0});
  eye.step(0.0, {3.0, 2.0});
  EXPECT_EQ(eye.state(), (std::array<double, 2>{1.0, 2.0}));
  eye.step(0.1, {9.0, 8.0});
  const auto near = eye.step(10.0, {0.5, 7.0});
  EXPECT_EQ(near[0], 1.0);
  EXPECT_NEAR(near[1], 4.0, 1e-12);
  // 0.35 s later it relaxes from 4 D, the limit of the better eye, not from 8.
  const auto later = eye.step(10.0 + 0.35 + 0.25, {0.5, 7.0});
  EXPECT_NEAR(later[1], 0.5 + 3.5 * std::exp(-1.0), 1e-12);
  EXPECT_EQ(tracking::shared_demand({1.0, -2.0}), -2.0);
  EXPECT_EQ(tracking::shared_demand({kInf, 1.5}), 1.5);
  EXPECT_EQ(tracking::shared_demand({kNan, kInf}), std::nullopt);
}

TEST(Accommodation, NonsenseChangesNothing) {
  Accommodation eye(AccommodationConfig{}, kYoung);
  EXPECT_EQ(eye.step(0.0, both(kNan)), both(0.0));
  EXPECT_EQ(eye.step(kNan, both(1.0)), both(0.0));
  eye.step(0.1, both(1.0));
  eye.step(0.2, both(3.0));
  const auto before = eye.step(0.7, both(3.0));
  EXPECT_EQ(eye.step(0.7, {kNan, kInf}), before);
  EXPECT_EQ(eye.step(0.3, both(0.0)), before);
  EXPECT_EQ(eye.step(kInf, both(0.0)), before);
  EXPECT_EQ(eye.step(kNan, both(0.0)), before);
  Accommodation same(AccommodationConfig{}, kYoung);
  same.step(0.1, both(1.0));
  same.step(0.2, both(3.0));
  EXPECT_NEAR(same.step(2.0, both(3.0))[0], eye.step(2.0, both(3.0))[0], 1e-12);
}

TEST(DelayedResponse, ManyCommandsWithinTheLatency) {
  // A ramp of commands comes out as the ramp's lag response: value = v (t - tau (1 - exp(-t / tau))).
  const double tau = 0.25, speed = 2.0;
  DelayedResponse response({.latency = 0.4, .time_constant_up = tau, .time_constant_down = tau}, 0.0);
  double value = 0.0;
  for (int i = 0; i <= 20000; ++i) {
    const double time = i * 1e-4;
    value = response.step(time, speed * time);
  }
  const double t = 2.0 - 0.4;
  EXPECT_NEAR(value, speed * (t - tau * (1.0 - std::exp(-t / tau))), 2.0 * speed * 1e-4);
}

TEST(DelayedResponse, NoLatencyAndNoTimeConstantIsTheCommandItself) {
  DelayedResponse response({.latency = 0.0, .time_constant_up = 0.0, .time_constant_down = 0.0}, 1.0);
  EXPECT_EQ(response.step(0.0, 2.0), 1.0);
  EXPECT_EQ(response.step(0.1, 3.0), 2.0);
  EXPECT_EQ(response.step(0.2, 3.0), 3.0);
}

TEST(PupilResponse, ConstrictsFasterThanItDilates) {
  const tracking::PupilConfig config;
  const auto way_after = [&](double from, double to, double time) {
    tracking::PupilResponse pupil(config, from);
    pupil.step(0.0, to);
    return (pupil.step(time, to) - from) / (to - from);
  };
  for (const double time : {0.1, 0.22, 0.4, 1.0, 3.0}) {
    const double since = std::max(0.0, time - config.latency);
    EXPECT_NEAR(way_after(0.006, 0.003, time), 1.0 - std::exp(-since / config.constriction_time_constant), 1e-12);
    EXPECT_NEAR(way_after(0.003, 0.006, time), 1.0 - std::exp(-since / config.dilation_time_constant), 1e-12);
  }
  // A flash: it turns round in the middle of the way.
  tracking::PupilResponse pupil(config, 0.006);
  pupil.step(0.0, 0.003);
  pupil.step(0.5, 0.006);
  const double turned = 0.003 + 0.003 * std::exp(-0.5 / config.constriction_time_constant);
  const double expected = 0.006 + (turned - 0.006) * std::exp(-0.28 / config.dilation_time_constant);
  EXPECT_NEAR(pupil.step(1.0, 0.006), expected, 1e-12);
}

}  // namespace
