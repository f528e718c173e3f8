// One call a frame: that each part is fed what the others say, and that frames of any length and samples of any kind
// leave a state that can be used.
#include "tracking/live_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/eye_movement.hpp"
#include "tracking/direction.hpp"

namespace {

using tracking::EyeState;
using tracking::GazeSource;
using tracking::LiveState;
using tracking::LookedAt;
using tracking::LookRequest;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kHalfPd = 0.0315;
constexpr LiveState::Wearer kWearer{{8.0, 8.0}, {0.004, 0.004}};

// Bare eyes before two walls: near below the horizon, far above it.
LookedAt look_at_walls(const LookRequest& request) {
  const glm::dvec3 middle = *tracking::unit_direction(request.gaze[0] + request.gaze[1]);
  LookedAt seen;
  seen.distance = request.distance.value_or(middle.y < 0.0 ? 0.4 : 4.0);
  const double distance = std::min(seen.distance, 1e6);
  const glm::dvec3 point = distance * middle;
  seen.gaze = {glm::normalize(point - glm::dvec3(kHalfPd, 0.0, 0.0)),
               glm::normalize(point + glm::dvec3(kHalfPd, 0.0, 0.0))};
  seen.demand = {1.0 / distance, 1.0 / distance};
  return seen;
}

LiveState::Frame frame(double time, const std::optional<tracking::GazeSample>& sample) {
  return {time, {}, sample, {0.003, 0.003}};
}

TEST(LiveState, FromTheChartToTheCard) {
  LiveState live({}, kWearer);
  support::Tracker tracker(90.0, 0.0, 1);
  const support::Saccade saccade{30.0, 2.0};  // from 10 deg above the horizon to 20 below
  const tracking::AccommodationConfig eye;
  const double far = tracking::settled_response(eye, 0.25), near = tracking::settled_response(eye, 2.5);
  std::optional<double> arrived;
  for (int i = 0; i < 360; ++i) {
    const double time = tracker.time(i);
    const EyeState& s = live.step(frame(time, tracker.sample(i, 0.0, 10.0 - saccade.angle_deg(time))), look_at_walls);
    EXPECT_EQ(s.source, GazeSource::tracker);
    if (!arrived && s.distance < 0.5) {
      arrived = time;
      EXPECT_EQ(s.phase, tracking::GazePhase::saccade) << "the depth goes with the saccade";
      // Both eyes are on the card, converged.
      EXPECT_NEAR(s.gaze[1].x - s.gaze[0].x, 2.0 * kHalfPd / 0.4, 0.01);
    }
    if (!arrived) {
      EXPECT_NEAR(s.accommodation[0], far, 1e-12);
      EXPECT_EQ(s.distance, 4.0);
    } else {
      const double since = time - *arrived - eye.latency;
      const double expected = since <= 0.0 ? far : near + (far - near) * std::exp(-since / eye.time_constant);
      EXPECT_NEAR(s.accommodation[1], expected, 1e-9);
      EXPECT_EQ(s.accommodation[0], s.accommodation[1]);
    }
    const double light = time - tracking::PupilConfig{}.latency;
    EXPECT_NEAR(
        s.pupil_diameter[0],
        0.003 + 0.001 * (light > 0.0 ? std::exp(-light / tracking::PupilConfig{}.constriction_time_constant) : 1.0),
        1e-12);
  }
  ASSERT_TRUE(arrived);
  EXPECT_LE(*arrived, saccade.end());
}

// Gaze on the edge between the walls: the tracker's noise crosses it, and eyes and focus stay.
TEST(LiveState, NoiseAcrossAnEdgeDoesNotSwingTheEyes) {
  LiveState live({}, kWearer);
  support::Tracker tracker(90.0, 0.3, 8);
  double steadiest = 0.0, last = 0.0;
  int changes = 0;
  for (int i = 0; i < 900; ++i) {
    const double time = tracker.time(i);
    const EyeState& s = live.step(frame(time, tracker.sample(i, 0.0, 0.15)), look_at_walls);
    const double convergence = tracking::angle_between(s.gaze[0], s.gaze[1]) / kDegree;
    if (time > 1.0) {
      changes += std::abs(convergence - last) > 0.5 ? 1 : 0;
      steadiest = std::max(steadiest, std::abs(convergence - last));
    }
    last = convergence;
  }
  // The walls' convergence differs by 8 degrees; in 9 s the depth may change for good now and then, smoothly.
  EXPECT_LE(changes, 30) << "seed 8";
  EXPECT_LE(steadiest, 1.3) << "seed 8: 8 deg with a time constant of 80 ms is 1.0 a frame";
}

TEST(LiveState, ABlinkChangesNothingThatIsSeen) {
  LiveState live({}, kWearer);
  support::Tracker tracker(90.0, 0.0, 1);
  EyeState before;
  for (int i = 0; i < 270; ++i) {
    auto sample = tracker.sample(i, 5.0, -12.0);
    sample.valid = i < 180 || i > 200;
    const EyeState& s = live.step(frame(tracker.time(i), sample), look_at_walls);
    if (i == 179) before = s;
    if (i >= 180) {
      EXPECT_LE(tracking::angle_between(s.gaze[0], before.gaze[0]), 1e-9) << i;
      EXPECT_EQ(s.source, i <= 200 ? GazeSource::held : GazeSource::tracker);
      EXPECT_NEAR(s.accommodation[0], before.accommodation[0], 1e-3);
    }
  }
}

TEST(LiveState, WithoutATrackerItLooksAhead) {
  LiveState live({}, kWearer);
  for (int i = 0; i < 10; ++i) {
    const EyeState& s = live.step(frame(0.02 * i, std::nullopt), look_at_walls);
    EXPECT_EQ(s.source, GazeSource::head);
    EXPECT_NEAR(s.distance, 4.0, 1e-12);
    EXPECT_NEAR(s.gaze[0].x, -kHalfPd / std::hypot(4.0, kHalfPd), 1e-9);
    EXPECT_TRUE(std::isinf(s.age));
  }
}

TEST(LiveState, NonsenseLeavesAStateThatCanBeUsed) {
  std::mt19937_64 random(77);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  LiveState live({}, kWearer);
  support::Tracker tracker(90.0, 0.3, 4);
  for (int i = 0; i < 2000; ++i) {
    auto sample = tracker.sample(i, 60.0 * unit(random), -20.0);
    if (unit(random) < 0.1) sample.combined->direction.x = nan;
    if (unit(random) < 0.1) sample.eye = {glm::dvec3(inf, 0.0, 0.0), glm::dvec3(0.0, 0.1, -1.0)};
    if (unit(random) < 0.1) sample.time = unit(random) < 0.5 ? -inf : 1e9 * unit(random);
    LiveState::Frame f = frame(unit(random) < 0.05 ? nan : i / 90.0, sample);
    if (unit(random) < 0.1) f.world_from_head.orientation.w = inf;
    if (unit(random) < 0.1) f.settled_pupil = {nan, inf};
    const EyeState& s = live.step(f, [&](const LookRequest& request) {
      LookedAt seen = look_at_walls(request);
      if (unit(random) < 0.1) seen.demand = {inf, nan};
      if (unit(random) < 0.1) seen.distance = inf;
      return seen;
    });
    for (std::size_t eye = 0; eye < 2; ++eye) {
      EXPECT_NEAR(glm::length(s.gaze[eye]), 1.0, 1e-12) << i << ", seed 77";
      EXPECT_TRUE(s.accommodation[eye] >= 0.0 && s.accommodation[eye] <= 8.0);
      EXPECT_TRUE(s.pupil_diameter[eye] >= 0.003 && s.pupil_diameter[eye] <= 0.004);
    }
    EXPECT_GT(s.distance, 0.0);
  }
}

}  // namespace
