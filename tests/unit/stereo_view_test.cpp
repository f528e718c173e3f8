// Poses, fields of view and the two ways to name a direction.
#include "tracking/stereo_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

namespace {

using tracking::Pose;

constexpr std::uint64_t kSeed = 33;
constexpr double kDegree = std::numbers::pi / 180.0;

Pose random_pose(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto next = [&] { return unit(random); };
  const glm::dquat q(next(), next(), next(), next());
  return {glm::normalize(q), glm::dvec3(next(), next(), next()) * 3.0};
}

TEST(Pose, ComposesAndInverts) {
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", pose " << i);
    const Pose world_from_head = random_pose(random);
    const Pose head_from_eye = random_pose(random);
    const glm::dvec3 p = random_pose(random).position;
    EXPECT_LE(glm::length((world_from_head * head_from_eye).point(p) - world_from_head.point(head_from_eye.point(p))),
              1e-14);
    EXPECT_LE(glm::length(world_from_head.inverse().point(world_from_head.point(p)) - p), 1e-14);
    EXPECT_LE(
        glm::length(world_from_head.point(p) - world_from_head.point(glm::dvec3(0.0)) - world_from_head.direction(p)),
        1e-14);
    EXPECT_NEAR(glm::length(world_from_head.direction(p)), glm::length(p), 1e-14);
  }
}

TEST(Pose, KnowsWhatIsNotFinite) {
  EXPECT_TRUE(Pose{}.is_finite());
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int i = 0; i < 3; ++i) {
      Pose pose;
      pose.position[i] = bad;
      EXPECT_FALSE(pose.is_finite());
    }
    for (int i = 0; i < 4; ++i) {
      Pose pose;
      pose.orientation[i] = bad;
      EXPECT_FALSE(pose.is_finite());
    }
  }
}

TEST(FieldOfView, SymmetricTakesTheVerticalAngle) {
  const auto fov = tracking::FieldOfView::symmetric(60.0 * kDegree, 1.5);
  EXPECT_NEAR(fov.tan_up, std::tan(30.0 * kDegree), 1e-15);
  EXPECT_EQ(fov.tan_up, fov.tan_down);
  EXPECT_NEAR(fov.tan_right, 1.5 * fov.tan_up, 1e-15);
  EXPECT_EQ(fov.tan_left, fov.tan_right);
}

TEST(YawPitch, PointsRightAndUp) {
  const auto expect = [](double yaw, double pitch, const glm::dvec3& direction) {
    EXPECT_LE(glm::length(tracking::direction_from_yaw_pitch(yaw * kDegree, pitch * kDegree) - direction), 1e-15);
  };
  expect(0.0, 0.0, {0.0, 0.0, -1.0});
  expect(90.0, 0.0, {1.0, 0.0, 0.0});
  expect(0.0, 90.0, {0.0, 1.0, 0.0});
  expect(-45.0, 0.0, {-std::sqrt(0.5), 0.0, -std::sqrt(0.5)});
  expect(0.0, -30.0, {0.0, -0.5, -std::sqrt(0.75)});
}

TEST(YawPitch, OrientationTurnsForwardToTheDirectionAndKeepsTheHorizon) {
  for (double yaw = -170.0; yaw <= 170.0; yaw += 17.0) {
    for (double pitch = -80.0; pitch <= 80.0; pitch += 16.0) {
      const glm::dquat q = tracking::orientation_from_yaw_pitch(yaw * kDegree, pitch * kDegree);
      EXPECT_LE(glm::length(q * glm::dvec3(0.0, 0.0, -1.0) -
                            tracking::direction_from_yaw_pitch(yaw * kDegree, pitch * kDegree)),
                1e-15 * 4.0);
      EXPECT_NEAR((q * glm::dvec3(1.0, 0.0, 0.0)).y, 0.0, 1e-15);
      EXPECT_GT((q * glm::dvec3(0.0, 1.0, 0.0)).y, 0.0);
    }
  }
}

// Straight back no smallest rotation is the only one; any will do, but a pose must stay finite.
TEST(ListingRotation, IsARotationEvenStraightBack) {
  for (const glm::dvec3& gaze : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1e-9, 0.0, 1.0), glm::dvec3(0.0, -1e-12, 2.0),
                                 glm::dvec3(1e-3, 2e-3, 1.0)}) {
    const glm::dmat3 turn = tracking::listing_rotation(gaze);
    SCOPED_TRACE(testing::Message() << gaze.x << " " << gaze.y << " " << gaze.z);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(glm::length(turn[i]), 1.0, 1e-6);
    }
    EXPECT_LE(glm::length(turn * glm::dvec3(0.0, 0.0, -1.0) - glm::normalize(gaze)), 1e-14);
    EXPECT_NEAR(glm::determinant(turn), 1.0, 1e-6);
  }
}

}  // namespace
