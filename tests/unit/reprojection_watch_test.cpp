// A turning head behind lenses: what the runtime's reprojection gets wrong, from poses frame by frame.
#include "app/vr/reprojection_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "lenses/reprojection.hpp"

namespace {

using tracking::Pose;

constexpr double kRadians = M_PI / 180.0, kPeriod = 1.0 / 90.0;

Pose turned(double yaw_deg) {
  Pose pose;
  pose.position = {0.0, 1.2, 0.3};
  pose.orientation = glm::angleAxis(yaw_deg * kRadians, glm::dvec3(0.0, 1.0, 0.0));
  return pose;
}

class ReprojectionWatchTest : public ::testing::Test {
 protected:
  ReprojectionWatchTest() {
    lenses::Lens lens;  // 6 D, so thin that the thin lens's formula holds
    lens.index = 1.5;
    lens.centre_thickness = 1e-5;
    lens.diameter = 0.07;
    lens.front = lenses::Sphere{0.0};
    lens.back = lenses::Sphere{-12.0};
    for (const tracking::Side side : {tracking::Side::right, tracking::Side::left}) {
      const bool worn = side == tracking::Side::right;
      const std::size_t index = lenses::append_lens(model_, worn ? &lens : nullptr, side, 0.00305);
      pair_.eyes[static_cast<std::size_t>(side)] = {
          .lens = model_.lens[index], .eye = lenses::make_eye_data({}, 0.0, 0.0035), .world_from_eye = {}};
    }
  }

  [[nodiscard]] double error() const { return watch_.error(model_, {&pair_, 1}, gaze_, kPeriod); }

  app::ReprojectionWatch watch_;
  lenses::LensModel model_;
  app::WornPair pair_;
  std::array<glm::dvec3, 2> gaze_{glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 0.0, -1.0)};
};

TEST_F(ReprojectionWatchTest, TheErrorIsThatOfTheHeadsSpeed) {
  for (int frame = 0; frame < 4; ++frame) {  // 90 deg/s to the left
    watch_.see(10.0 + frame * kPeriod, turned(frame));
  }
  EXPECT_NEAR(watch_.head_turn().y, 90.0 * kRadians, 1e-9);
  EXPECT_NEAR(std::hypot(watch_.head_turn().x, watch_.head_turn().z), 0.0, 1e-9);
  const double thin = lenses::thin_lens_reprojection_error(6.0, 0.013 + 0.00305, 1.0 * kRadians);
  EXPECT_NEAR(error(), thin, 2e-3 * thin);         // but for 10 um of thickness
  EXPECT_NEAR(thin / kRadians * 60.0, 6.4, 0.05);  // arcmin: what is at stake at an ordinary turn
}

TEST_F(ReprojectionWatchTest, ShortWayRound) {
  Pose flipped = turned(1.0);
  flipped.orientation = -flipped.orientation;  // the same pose
  watch_.see(0.0, turned(0.0));
  watch_.see(kPeriod, flipped);
  EXPECT_NEAR(glm::length(watch_.head_turn()), 90.0 * kRadians, 1e-9);
}

TEST_F(ReprojectionWatchTest, NothingIsSaidOfWhatIsNotKnown) {
  watch_.see(0.0, turned(0.0));
  EXPECT_FALSE(watch_.is_known());
  EXPECT_EQ(error(), 0.0) << "the first frame";
  watch_.see(kPeriod, turned(1.0));
  EXPECT_GT(error(), 0.0);
  watch_.see(kPeriod, turned(2.0));
  EXPECT_EQ(error(), 0.0) << "time stood still";
  watch_.see(5.0, turned(3.0));
  EXPECT_EQ(error(), 0.0) << "after a pause";
  EXPECT_FALSE(watch_.is_known());
  watch_.see(5.0 + kPeriod, turned(4.0));
  EXPECT_TRUE(watch_.is_known());
  EXPECT_GT(error(), 0.0);
  watch_.forget();
  watch_.see(5.0 + 2.0 * kPeriod, turned(90.0));
  EXPECT_EQ(error(), 0.0) << "the world moved";
}

TEST_F(ReprojectionWatchTest, BareEyesHaveNone) {
  watch_.see(0.0, turned(0.0));
  watch_.see(kPeriod, turned(1.0));
  pair_.eyes[0].lens = pair_.eyes[1].lens;
  EXPECT_EQ(error(), 0.0);
}

}  // namespace
