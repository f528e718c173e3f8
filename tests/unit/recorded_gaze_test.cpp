// The pure parts of the gaze layer: a trace in time, and directions as poses.
#include "xr/layer/recorded_gaze.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "xr/layer/gaze_poses.hpp"

namespace {

using namespace xr::layer;
using tracking::Side;

constexpr XrTime kStart = 123'456'789'000;

constexpr XrTime after(double seconds) {
  return kStart + static_cast<XrTime>(seconds * 1e9);
}

// Rows at 2.0, 2.1, ... s that look 0, 1, ... degrees to the right; the second is a blink.
tracking::GazeTrace rows(int count) {
  tracking::GazeTrace trace;
  for (int i = 0; i < count; ++i) {
    tracking::TraceRow row;
    row.time = 2.0 + 0.1 * i;
    row.gaze.fill(tracking::direction_from_yaw_pitch(i * 0.017453292519943295, 0.0));
    row.gaze_valid = i != 1;
    trace.rows.push_back(row);
  }
  return trace;
}

double degrees(const GazeReading& reading) {
  return std::atan2(reading.direction[0].x, -reading.direction[0].z) / 0.017453292519943295;
}

TEST(RecordedGaze, IsTheLastRowNotLaterThanTheTime) {
  const RecordedGaze gaze(rows(5), AtEnd::hold);
  struct Case {
    double time, degrees, sample;
  };
  for (const Case& c : {Case{0.0, 0.0, 0.0}, Case{0.0999, 0.0, 0.0}, Case{0.2, 2.0, 0.2}, Case{0.2999, 2.0, 0.2},
                        Case{0.3, 3.0, 0.3}, Case{0.4, 4.0, 0.4}}) {
    const GazeReading reading = gaze.at(after(c.time), kStart);
    EXPECT_TRUE(reading.valid) << c.time;
    EXPECT_NEAR(degrees(reading), c.degrees, 1e-9) << c.time;
    // Times of rows are decimals; a nanosecond is their rounding.
    EXPECT_NEAR(static_cast<double>(reading.sample_time - after(c.sample)), 0.0, 1.0) << c.time;
  }
  EXPECT_FALSE(gaze.at(after(0.15), kStart).valid) << "the blink";
  EXPECT_NEAR(degrees(gaze.at(after(-3.0), kStart)), 0.0, 1e-9) << "before the start";
}

TEST(RecordedGaze, HoldsLoopsOrStops) {
  const auto at = [](AtEnd end, double time) { return RecordedGaze(rows(5), end).at(after(time), kStart); };
  EXPECT_TRUE(at(AtEnd::hold, 100.0).valid);
  EXPECT_NEAR(degrees(at(AtEnd::hold, 100.0)), 4.0, 1e-9);
  EXPECT_EQ(at(AtEnd::hold, 100.0).sample_time, after(100.0)) << "as if seen anew";
  // The last row stays for 0.1 s, as the others did.
  EXPECT_TRUE(at(AtEnd::stop, 0.49).valid);
  EXPECT_FALSE(at(AtEnd::stop, 0.51).valid);
  EXPECT_NEAR(degrees(at(AtEnd::loop, 0.49)), 4.0, 1e-9);
  EXPECT_NEAR(degrees(at(AtEnd::loop, 50.01)), 0.0, 1e-9);
  EXPECT_NEAR(degrees(at(AtEnd::loop, 50.23)), 2.0, 1e-9);
  EXPECT_NEAR(static_cast<double>(at(AtEnd::loop, 50.23).sample_time - after(50.2)), 0.0, 2.0);
  EXPECT_TRUE(RecordedGaze(rows(1), AtEnd::loop).at(after(5.0), kStart).valid) << "a single row loops too";
}

TEST(GazePoses, CombineTwoEyesOnAPointToTheLineFromBetweenThem) {
  constexpr unsigned kSeed = 20120613;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> across(-1.0, 1.0), distance(0.1, 20.0);
  for (int i = 0; i < 1000; ++i) {
    const double z = distance(random);
    const glm::dvec3 point(across(random) * z, across(random) * z, -z);
    const glm::dvec3 half(kHalfPupillaryDistance, 0.0, 0.0);
    const glm::dvec3 combined =
        combined_direction({glm::normalize(point - half), glm::normalize(point + half)});  // right, left
    EXPECT_LT(glm::length(combined - glm::normalize(point)), 1e-14) << "seed " << kSeed;
  }
  // Eyes that look behind the head, or each its own way, still give a direction.
  for (const auto& pair :
       {std::array{glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1)}, std::array{glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0)},
        std::array{glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)}}) {
    EXPECT_NEAR(glm::length(combined_direction(pair)), 1.0, 1e-12);
  }
}

TEST(GazePoses, TurnAnEyeByListingsLawWhereItStands) {
  const glm::dvec3 up_right = glm::normalize(glm::dvec3(0.5, 0.5, -1.0));
  const std::array both{up_right, up_right};
  for (const Side side : {Side::right, Side::left}) {
    const tracking::Pose pose = eye_pose(side, both);
    EXPECT_LT(glm::length(pose.direction({0.0, 0.0, -1.0}) - up_right), 1e-12);
    EXPECT_DOUBLE_EQ(pose.position.x, side == Side::right ? kHalfPupillaryDistance : -kHalfPupillaryDistance);
    // The axis of the turn lies in the plane across straight ahead.
    EXPECT_NEAR(glm::axis(pose.orientation).z, 0.0, 1e-12);
  }
}

TEST(GazePoses, AreTrackedAsAWholeOrNotAtAll) {
  EXPECT_EQ(gaze_flags(15), 15U);
  EXPECT_EQ(gaze_flags(7), 3U);
  EXPECT_EQ(gaze_flags(11), 3U);
  EXPECT_EQ(gaze_flags(3), 3U);
  EXPECT_EQ(gaze_flags(1), 0U);
  EXPECT_EQ(gaze_flags(13), 0U);
  EXPECT_EQ(gaze_flags(0), 0U);
}

}  // namespace
