// A tracker's line through the lenses: both eyes on one point of the scene, before the lenses turned as the tracker
// says.
#include "render/live_gaze.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lenses/trace.hpp"
#include "tests/support/meniscus.hpp"
#include "tests/support/random_lens.hpp"
#include "tracking/direction.hpp"

namespace {

using render::EyeOptics;
using render::Fixation;
using render::SceneAlong;
using render::Viewing;
using support::kRadians;
using tracking::Line;
using tracking::Pose;

constexpr double kHalfPd = 0.0315;  // m

class LiveGazeTest : public testing::Test {
 protected:
  [[nodiscard]] lenses::f64::Table table() const { return lenses::f64::Table{model_.table}; }

  std::array<EyeOptics, 2> both(const lenses::Lens* right, const lenses::Lens* left, const Pose& world_from_head = {}) {
    std::array<EyeOptics, 2> eyes;
    for (const auto side : {lenses::Side::right, lenses::Side::left}) {
      const auto i = static_cast<std::size_t>(side);
      const lenses::Eye eye;
      const std::size_t lens = lenses::append_lens(model_, i == 0 ? right : left, side, eye.entrance_pupil_depth);
      const double x = side == lenses::Side::right ? kHalfPd : -kHalfPd;
      eyes[i] = {model_.lens[lens], lenses::make_eye_data(eye, 8.0, 0.0035),
                 world_from_head * Pose{glm::dquat(1.0, 0.0, 0.0, 0.0), {x, 0.0, 0.0}}};
    }
    return eyes;
  }

  static lenses::Lens meniscus(double power, const glm::dvec2& decentration = {}) {
    lenses::Lens lens = support::meniscus(power);
    lens.fit.decentration = decentration;
    return lens;
  }

  // A wall across a pose's -z at a distance.
  static SceneAlong wall(double distance, const Pose& world_from_wall = {}) {
    return [=](const glm::dvec3& origin, const glm::dvec3& direction) -> std::optional<double> {
      const Pose wall_from_world = world_from_wall.inverse();
      const double along = wall_from_world.direction(direction).z;
      const double t = (-distance - wall_from_world.point(origin).z) / along;
      return t > 0.0 && std::isfinite(t) ? std::optional(t) : std::nullopt;
    };
  }

  static double miss(const render::LineOfSight& line, const glm::dvec3& point) {
    return glm::length(glm::cross(point - line.start, line.direction));
  }

 private:
  lenses::LensModel model_;
};

TEST_F(LiveGazeTest, BareEyesLookWhereTheTrackersRayMeetsTheScene) {
  const Pose head{tracking::orientation_from_yaw_pitch(0.5, -0.2), {0.3, 1.2, -0.4}};
  const auto eyes = both(nullptr, nullptr, head);
  for (const double distance : {0.3, 0.6, 3.0, 100.0}) {
    for (const auto& [yaw, pitch] : std::vector<std::pair<double, double>>{{0, 0}, {20, -10}, {-30, 25}, {5, -35}}) {
      for (const glm::dvec3& origin : {glm::dvec3(0.0), glm::dvec3(0.0315, 0.0, 0.0), glm::dvec3(0.0, 0.005, 0.012)}) {
        const Line gaze{origin, tracking::direction_from_yaw_pitch(yaw * kRadians, pitch * kRadians)};
        const Fixation f = render::fixate_combined(table(), eyes, Viewing::gaze, head, gaze, wall(distance, head));
        // The tracker's own ray, met with the wall.
        const glm::dvec3 start = head.point(gaze.origin), along = head.direction(gaze.direction);
        const glm::dvec3 expected = start + *wall(distance, head)(start, along) * along;
        EXPECT_LE(glm::length(f.line[0].point - expected), 1e-6 * distance)
            << distance << " m, " << yaw << "," << pitch;
        for (const auto& line : f.line) EXPECT_LE(miss(line, expected), 1e-6 * distance);
        EXPECT_NEAR(f.distance, glm::length(expected - head.position), 1e-6 * distance);
      }
    }
  }
}

TEST_F(LiveGazeTest, ThroughLensesBothRaysReachOnePoint) {
  // Equal lenses, prism base out, and two powers that differ: -4 D and +2 D with a decentration up.
  const lenses::Lens minus = meniscus(-6.0), plus = meniscus(6.0);
  const lenses::Lens out_right = meniscus(-4.0, {0.005, 0.0}), out_left = meniscus(-4.0, {-0.005, 0.0});
  const lenses::Lens one = meniscus(-4.0), other = meniscus(2.0, {0.0, 0.003});
  for (const auto& [right, left] :
       {std::pair{&minus, &minus}, {&plus, &plus}, {&out_right, &out_left}, {&one, &other}}) {
    const auto eyes = both(right, left);
    for (const double distance : {0.4, 4.0}) {
      for (const auto& [yaw, pitch] : std::vector<std::pair<double, double>>{{0, 0}, {15, -10}, {-20, 12}}) {
        // From midway between the centres of rotation, which all lines of an eye pass.
        const Line gaze{{0.0, 0.0, eyes[0].eye.pupil.y},
                        tracking::direction_from_yaw_pitch(yaw * kRadians, pitch * kRadians)};
        const Fixation f = render::fixate_combined(table(), eyes, Viewing::gaze, {}, gaze, wall(distance));
        EXPECT_NEAR(f.line[0].point.z, -distance, 1e-9);
        for (const auto& line : f.line) {
          EXPECT_TRUE(line.through_lens);
          EXPECT_LE(miss(line, f.line[0].point), 1e-9);
        }
        // Turned as the tracker says.
        const glm::dvec3 turned = render::combined_direction({f.line[0].gaze, f.line[1].gaze});
        EXPECT_LE(tracking::angle_between(turned, gaze.direction), 1e-8);
      }
    }
  }
}

// Straight casting would find another point: at 20 deg through 6 D by 3 degrees.
TEST_F(LiveGazeTest, TheLensIsNotPassedOver) {
  const lenses::Lens lens = meniscus(6.0);
  const auto eyes = both(&lens, &lens);
  const Line gaze{{}, tracking::direction_from_yaw_pitch(20.0 * kRadians, 0.0)};
  const Fixation f = render::fixate_combined(table(), eyes, Viewing::gaze, {}, gaze, wall(4.0));
  const double seen = std::atan2(f.line[0].point.x, 4.0) / kRadians;
  EXPECT_NEAR(20.0 - seen, 3.8, 0.5);
}

TEST_F(LiveGazeTest, ADistanceTakesTheScenesPlace) {
  const lenses::Lens lens = meniscus(-3.0);
  const auto eyes = both(&lens, &lens);
  const Line gaze{{}, tracking::direction_from_yaw_pitch(0.2, -0.3)};
  const SceneAlong nothing = [](const glm::dvec3&, const glm::dvec3&) -> std::optional<double> {
    ADD_FAILURE() << "the scene was asked";
    return std::nullopt;
  };
  for (const double distance : {0.25, 0.4, 2.0}) {
    const Fixation f = render::fixate_combined(table(), eyes, Viewing::gaze, {}, gaze, nothing, distance);
    EXPECT_NEAR(f.distance, distance, 1e-9);
    EXPECT_NEAR(glm::length(f.line[0].point), distance, 1e-9);
    // The same as of a scene that is there.
    const double z = -f.line[0].point.z;
    const Fixation same = render::fixate_combined(table(), eyes, Viewing::gaze, {}, gaze, wall(z));
    EXPECT_LE(glm::length(same.line[1].gaze - f.line[1].gaze), 1e-7);
    EXPECT_NEAR(same.demand[0], f.demand[0], 1e-6);
  }
  const Fixation sky = render::fixate_combined(table(), eyes, Viewing::gaze, {}, gaze, nothing, INFINITY);
  EXPECT_TRUE(std::isinf(sky.distance));
  EXPECT_LE(glm::length(sky.line[0].direction - sky.line[1].direction), 1e-6);
}

TEST_F(LiveGazeTest, AnEdgeOfTheSceneLeavesAnAnswer) {
  const lenses::Lens lens = meniscus(6.0);
  const auto eyes = both(&lens, &lens);
  // Near to the right of x = 0, far to the left.
  const SceneAlong edge = [](const glm::dvec3& origin, const glm::dvec3& direction) -> std::optional<double> {
    const double near = (-0.4 - origin.z) / direction.z;
    return origin.x + near * direction.x > 0.0 ? near : (-5.0 - origin.z) / direction.z;
  };
  for (int i = -20; i <= 20; ++i) {
    const Line gaze{{}, tracking::direction_from_yaw_pitch(0.002 * i, 0.0)};
    const Fixation f = render::fixate_combined(table(), eyes, Viewing::gaze, {}, gaze, edge);
    EXPECT_TRUE(std::abs(f.line[0].point.z + 0.4) < 1e-9 || std::abs(f.line[0].point.z + 5.0) < 1e-9);
    for (const auto& line : f.line) EXPECT_LE(miss(line, f.line[0].point), 1e-9);
  }
}

TEST_F(LiveGazeTest, TwoLinesKeepTheirGazeAndFindTheirDistance) {
  const lenses::Lens lens = meniscus(-5.0);
  const auto eyes = both(&lens, &lens);
  constexpr double kNoise = 0.3 * kRadians;
  const glm::dvec3 target(0.05, -0.1, -0.5);
  const Fixation exact = render::fixate(table(), eyes, Viewing::gaze, target, glm::length(target));
  const std::array gaze{exact.line[0].gaze, exact.line[1].gaze};
  // What the scene has there is what they look at.
  const Fixation seen = render::fixate_each(table(), eyes, Viewing::gaze, gaze, kNoise, wall(0.5));
  EXPECT_EQ(seen.line[0].gaze, exact.line[0].gaze);
  EXPECT_EQ(seen.line[1].gaze, exact.line[1].gaze);
  EXPECT_NEAR(seen.distance, glm::length(target), 1e-3);
  EXPECT_NEAR(seen.demand[0], exact.demand[0], 0.01);
  // Through a window at 3 m: vergence says otherwise, and the eyes focus where they meet.
  const Fixation through = render::fixate_each(table(), eyes, Viewing::gaze, gaze, kNoise, wall(3.0));
  // 3 %: the lines begin at the lenses, 20 mm before the eyes.
  EXPECT_NEAR(1.0 / through.distance, 1.0 / glm::length(target), 0.05 / glm::length(target));
  // Parallel eyes look into the distance even past a near edge.
  const std::array ahead{glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 0.0, -1.0)};
  const auto bare = both(nullptr, nullptr);
  const Fixation far = render::fixate_each(table(), bare, Viewing::gaze, ahead, kNoise, wall(0.4));
  EXPECT_TRUE(std::isinf(far.distance));
  EXPECT_NEAR(far.demand[0], 0.0, 1e-5);
  EXPECT_NEAR(render::fixate_each(table(), bare, Viewing::gaze, ahead, kNoise, wall(0.4), 2.0).demand[1], 0.5, 0.01);
}

}  // namespace
