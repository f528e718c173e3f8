// The gaze layer in the real loader's chain over a real Monado, asked by plain OpenXR calls as any program asks.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/support/gaze_program.hpp"

namespace {

using support::gaze_row;
using support::GazeProgram;
using support::kTrackedBits;
using support::kValidBits;

constexpr double kDegree = 0.017453292519943295;
// A float quaternion's own error, with some to spare for the runtime's sums in float.
constexpr double kFloatPose = 2e-6;

glm::dvec3 yaw(double degrees, double pitch_degrees = 0.0) {
  return tracking::direction_from_yaw_pitch(degrees * kDegree, pitch_degrees * kDegree);
}

// Straight ahead for 1 s, 20 degrees to the right for 1 s, a blink, then down.
std::string three_looks() {
  return gaze_row(5.0, yaw(0), yaw(0)) + gaze_row(6.0, yaw(20), yaw(20)) + gaze_row(7.0, yaw(0), yaw(0), false) +
         gaze_row(7.2, yaw(0, -30), yaw(0, -30));
}

constexpr XrTime seconds(double s) {
  return static_cast<XrTime>(s * 1e9);
}

class GazeLayer : public testing::Test {
 protected:
  GazeLayer() { support::enable_layers(support::kGazeLayer); }
  support::Monado monado_;
};

TEST_F(GazeLayer, GivesTheTraceAtTheTimesAskedFor) {
  const support::TraceFile trace(monado_, three_looks());
  GazeProgram program;
  EXPECT_FALSE(program.is_active());
  EXPECT_EQ(program.gaze(program.now()).flags, 0U) << "before the focus";
  program.wait_for_focus();
  EXPECT_TRUE(program.is_active());
  const XrTime start = program.now();
  const auto look = [&](double at, const glm::dvec3& direction, double sample) {
    const auto gaze = program.gaze(start + seconds(at));
    EXPECT_EQ(gaze.flags, kValidBits | kTrackedBits) << at;
    EXPECT_LT(glm::length(gaze.direction - direction), kFloatPose) << at;
    EXPECT_EQ(gaze.sample_time, start + seconds(sample)) << at;
  };
  look(0.0, yaw(0), 0.0);
  look(0.999, yaw(0), 0.0);
  look(1.0, yaw(20), 1.0);
  look(1.5, yaw(20), 1.0);
  EXPECT_EQ(program.gaze(start + seconds(2.1)).flags, 0U) << "in a blink";
  EXPECT_EQ(program.gaze(start + seconds(2.1)).sample_time, 0);
  EXPECT_TRUE(program.is_active()) << "a blink does not take the tracker away";
  look(2.5, yaw(0, -30), 2.5);  // the end is held, and counts as seen anew
}

}  // namespace
