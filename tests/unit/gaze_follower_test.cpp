// Where a tracker's samples say that the eyes look: through blinks, losses, head turns and samples in any order.
#include "tracking/gaze_follower.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/support/eye_movement.hpp"
#include "tracking/direction.hpp"

namespace {

using tracking::FollowedGaze;
using tracking::GazeFollower;
using tracking::GazeSample;
using tracking::GazeSource;
using tracking::Pose;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kFrame = 1.0 / 90.0;

glm::dvec3 towards(double yaw, double pitch = 0.0) {
  return tracking::direction_from_yaw_pitch(yaw * kDegree, pitch * kDegree);
}
GazeSample combined(std::optional<double> time, const glm::dvec3& direction) {
  GazeSample sample;
  sample.time = time;
  sample.combined = tracking::Line{{}, direction};
  return sample;
}
GazeSample lost(double time) {
  GazeSample sample = combined(time, {0.0, 0.0, 0.0});
  sample.valid = false;
  return sample;
}
Pose head_at_yaw(double degrees) {
  return {tracking::orientation_from_yaw_pitch(degrees * kDegree, 0.0), {}};
}
double off(const glm::dvec3& a, const glm::dvec3& b) {
  return tracking::angle_between(a, b) / kDegree;
}

// A second of steady gaze, frame by frame; returns the time of the last frame.
double settle(GazeFollower& follower, const glm::dvec3& gaze) {
  double time = 0.0;
  for (int i = 0; i <= 90; ++i) {
    time = i * kFrame;
    const FollowedGaze g = follower.step(time, {}, combined(time, gaze));
    EXPECT_EQ(g.source, GazeSource::tracker);
    EXPECT_EQ(g.jumped, i == 0);
    EXPECT_LE(off(g.target[0], gaze), 1e-9);
    EXPECT_LE(off(g.pupil[1], gaze), 1e-9);
  }
  return time;
}

TEST(GazeFollower, WithoutATrackerTheHeadPoints) {
  GazeFollower follower;
  for (int i = 0; i < 10; ++i) {
    const FollowedGaze g = follower.step(i * kFrame, head_at_yaw(5.0 * i), std::nullopt);
    EXPECT_EQ(g.source, GazeSource::head);
    EXPECT_EQ(g.target[0], glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_TRUE(std::isinf(g.age));
  }
}

TEST(GazeFollower, ABlinkIsHeldAndALossHandedToTheHead) {
  GazeFollower follower;
  const glm::dvec3 gaze = towards(20.0, -10.0);
  const double since = settle(follower, gaze);
  const double angle = off(gaze, {0.0, 0.0, -1.0});
  for (int i = 1; i <= 200; ++i) {
    const double time = since + i * kFrame;
    const FollowedGaze g = follower.step(time, {}, lost(time));
    EXPECT_NEAR(g.age, time - since, 1e-12);
    if (g.age <= 0.5) {
      EXPECT_EQ(g.source, GazeSource::held);
      EXPECT_LE(off(g.pupil[0], gaze), 1e-9);
    } else {
      EXPECT_EQ(g.source, GazeSource::head);
      // An exponential return, with the time constant of the configuration.
      EXPECT_NEAR(off(g.pupil[0], {0.0, 0.0, -1.0}), angle * std::exp(-(g.age - 0.5) / 0.2), 1e-6);
    }
  }
  // Back at once when the tracker is.
  const double time = since + 201 * kFrame;
  const FollowedGaze back = follower.step(time, {}, combined(time, gaze));
  EXPECT_EQ(back.source, GazeSource::tracker);
  EXPECT_TRUE(back.jumped);
  EXPECT_LE(off(back.pupil[0], gaze), 1e-9);
}

TEST(GazeFollower, TheReturnDoesNotDependOnFrames) {
  const glm::dvec3 gaze = towards(20.0, -10.0);
  const auto after = [&](double step) {
    GazeFollower follower;
    const double since = settle(follower, gaze);
    FollowedGaze g;
    for (int i = 1; i * step <= 0.9 + 1e-9; ++i) g = follower.step(since + i * step, {}, std::nullopt);
    return off(g.pupil[0], {0.0, 0.0, -1.0});
  };
  EXPECT_NEAR(after(0.9 / 18), after(0.9 / 81), 1e-6);
  EXPECT_NEAR(after(0.9 / 65), after(0.9 / 81), 1e-6);
  EXPECT_NEAR(after(0.9), after(0.9 / 81), 1e-6);
}

TEST(GazeFollower, FramesBetweenSamplesAreStillTheTrackers) {
  GazeFollower follower;
  const glm::dvec3 gaze = towards(-15.0);
  for (int i = 0; i < 90; ++i) {
    // A tracker of 30 Hz, two frames late, whose last sample the caller repeats.
    const double sample_time = (i / 3) * 3 * kFrame - 2.0 * kFrame;
    const FollowedGaze g = follower.step(i * kFrame, {}, combined(sample_time, gaze));
    EXPECT_EQ(g.source, GazeSource::tracker);
    EXPECT_LE(g.age, 3.0 * kFrame);
  }
  // One that stands still is lost, whatever it says of itself.
  for (int i = 90; i < 120; ++i) {
    const FollowedGaze g = follower.step(i * kFrame, {}, combined(87 * kFrame - 2.0 * kFrame, gaze));
    EXPECT_EQ(g.source, i * kFrame - 87.0 * kFrame > 0.1 ? GazeSource::held : GazeSource::tracker) << i;
  }
}

TEST(GazeFollower, AnEyeThatCountersTheHeadStands) {
  // The head turns at 60 deg/s, the gaze stays on a target of the world: no lag, no saccade.
  GazeFollower follower;
  for (int i = 0; i < 60; ++i) {
    const double time = i * kFrame;
    const double yaw = -20.0 + 60.0 * time;
    const FollowedGaze g = follower.step(time, head_at_yaw(yaw), combined(time, towards(-yaw)));
    EXPECT_EQ(g.jumped, i == 0);
    EXPECT_LE(off(g.pupil[0], towards(-yaw)), 1e-6) << i;
  }
}

TEST(GazeFollower, ALateSampleIsOfTheHeadOfItsTime) {
  GazeFollower follower;
  const double late = 0.06;
  for (int i = 0; i < 60; ++i) {
    const double time = i * kFrame;
    const auto yaw_at = [](double t) { return -20.0 + 60.0 * t; };
    const FollowedGaze g =
        follower.step(time, head_at_yaw(yaw_at(time)), combined(time - late, towards(-yaw_at(time - late))));
    if (time > 0.4) {  // before, there was no head to go back to, and what that did has to be forgotten
      EXPECT_LE(off(g.target[0], towards(-yaw_at(time))), 0.1) << i;
    }
  }
}

TEST(GazeFollower, HeldGazeStaysWithinTheSocket) {
  GazeFollower follower;
  const double since = settle(follower, towards(0.0));
  for (int i = 1; i <= 40; ++i) {
    const double time = since + i * kFrame;
    const FollowedGaze g = follower.step(time, head_at_yaw(3.0 * i), std::nullopt);
    EXPECT_NEAR(off(g.pupil[0], {0.0, 0.0, -1.0}), std::min(3.0 * i, 50.0), 1e-6);
    EXPECT_LE(g.pupil[0].x, 0.0);
  }
}

TEST(GazeFollower, SamplesInAnyOrderWithAnyTimes) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  support::Tracker tracker(120.0, 0.1, 5);
  GazeFollower follower;
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const glm::dvec3 truth = towards(12.0, 5.0);
  for (int i = 0; i < 3000; ++i) {
    const double time = i * kFrame;
    const int newest = static_cast<int>(time * 120.0);
    // Up to 3 samples back, now and then none, or nonsense.
    GazeSample sample = tracker.sample(std::max(0, newest - static_cast<int>(4.0 * unit(random))), 12.0, 5.0);
    const double kind = unit(random);
    if (kind < 0.02) sample.combined->direction = {nan, 0.0, -1.0};
    if (kind > 0.02 && kind < 0.04) sample.combined->direction = {0.0, 0.0, 0.0};
    if (kind > 0.04 && kind < 0.06) sample.combined->direction = {inf, 1.0, -1.0};
    if (kind > 0.06 && kind < 0.08) sample.time = nan;
    if (kind > 0.08 && kind < 0.10) sample.combined->origin = {nan, 0.0, 0.0};
    Pose head;
    if (kind > 0.10 && kind < 0.12) head.orientation = glm::dquat(nan, 0.0, 0.0, 0.0);
    if (kind > 0.12 && kind < 0.14) head.orientation = glm::dquat(0.0, 0.0, 0.0, 0.0);
    const FollowedGaze g = follower.step(kind > 0.98   ? nan
                                         : kind > 0.96 ? time - 0.2
                                                       : time,
                                         head, kind > 0.9 ? std::nullopt : std::optional(sample));
    EXPECT_NEAR(glm::length(g.pupil[0]), 1.0, 1e-12);
    EXPECT_NE(g.source, GazeSource::head);
    if (i > 90) {
      EXPECT_LE(off(g.pupil[0], truth), 0.2) << i;
      EXPECT_LE(off(g.target[1], truth), 0.4) << i;
    }
  }
}

TEST(GazeFollower, AClockThatBeginsAnewIsFollowed) {
  GazeFollower follower;
  double time = settle(follower, towards(10.0));
  for (int i = 1; i < 200; ++i) {
    time += kFrame;
    // The tracker restarted, and its clock with it.
    const FollowedGaze g = follower.step(time, {}, combined(-500.0 + i * kFrame, towards(-10.0)));
    EXPECT_EQ(g.source, GazeSource::tracker);
    EXPECT_LE(off(g.pupil[0], towards(-10.0)), 1e-9);
  }
}

TEST(GazeFollower, TwoEyesKeepTheirOwnLines) {
  GazeFollower follower;
  GazeSample sample;
  sample.eye = {5.0 * towards(8.0, 3.0), 0.1 * towards(13.0, 2.0)};
  FollowedGaze g;
  for (int i = 0; i < 30; ++i) {
    g = follower.step(i * kFrame, {}, sample);
    EXPECT_TRUE(g.two_lines);
    EXPECT_LE(off(g.target[0], towards(8.0, 3.0)), 1e-9);
    EXPECT_LE(off(g.pupil[1], towards(13.0, 2.0)), 1e-9);
  }
  // With one eye lost, the other leads both.
  sample.eye[0] = glm::dvec3(0.0);
  g = follower.step(30 * kFrame, {}, sample);
  EXPECT_FALSE(g.two_lines);
  EXPECT_TRUE(g.jumped);
  EXPECT_LE(off(g.target[0], towards(13.0, 2.0)), 1e-9);
  // A combined line is better than one eye's.
  sample.combined = tracking::Line{{0.01, 0.0, 0.0}, towards(10.5, 2.5)};
  g = follower.step(31 * kFrame, {}, sample);
  EXPECT_EQ(g.origin.x, 0.01);
}

// A tracker that misses single samples must not shake the picture: the filter goes on where it was.
TEST(GazeFollower, SingleMissesDoNotRestartTheFilter) {
  GazeFollower follower;
  support::Tracker tracker(90.0, 0.3, 3);
  double farthest = 0.0;
  for (int i = 0; i < 2700; ++i) {
    const double time = tracker.time(i);
    const FollowedGaze g = follower.step(time, {}, i % 7 == 3 ? lost(time) : tracker.sample(i, 5.0));
    if (time > 2.0) {
      EXPECT_FALSE(g.jumped) << time;
      EXPECT_EQ(g.source, i % 7 == 3 ? GazeSource::held : GazeSource::tracker);
      farthest = std::max(farthest, off(g.pupil[0], towards(5.0)));
    }
  }
  EXPECT_LE(farthest, 0.16);  // 0.12 deg is the greatest without misses; a seventh of the samples gone
}

// Where the scene is recentred, the world turns about the head: nothing of it is seen in the head, neither while a
// sample comes in nor while one is held.
TEST(GazeFollower, ATurnOfTheWorldMovesNoEyeInTheHead) {
  GazeFollower still, turned;
  const glm::dquat turn = tracking::orientation_from_yaw_pitch(70.0 * kDegree, 0.0);
  for (int i = 0; i < 120; ++i) {
    const double time = i * kFrame;
    const Pose before = head_at_yaw(0.3 * i);
    Pose after = before;
    if (i >= 60) {
      after.orientation = turn * after.orientation;
    }
    if (i == 60) {
      turned.turn_world(turn);
    }
    const GazeSample sample = i < 100 ? combined(time - 0.02, towards(5.0 * std::sin(0.1 * i), 2.0)) : lost(time);
    const FollowedGaze a = still.step(time, before, sample), b = turned.step(time, after, sample);
    for (const std::size_t eye : {0U, 1U}) {
      EXPECT_LE(off(a.target[eye], b.target[eye]), 1e-6) << i;  // degrees: rounding
      EXPECT_LE(off(a.pupil[eye], b.pupil[eye]), 1e-6) << i;
    }
    EXPECT_EQ(a.phase, b.phase) << i;
    EXPECT_EQ(a.source, b.source) << i;
  }
}

}  // namespace
