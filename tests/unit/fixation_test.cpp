// Two eyes behind their lenses on one point: convergence, the gaze that a lens asks for, the shared accommodation.
#include "render/fixation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lenses/trace.hpp"
#include "tests/support/meniscus.hpp"
#include "tests/support/random_lens.hpp"

namespace {

using render::EyeOptics;
using render::Fixation;
using render::LineOfSight;
using render::Viewing;
using support::kRadians;

constexpr double kHalfPd = 0.0315;  // m

class FixationTest : public testing::Test {
 protected:
  lenses::f64::Table table() const { return lenses::f64::Table{model_.table}; }

  EyeOptics eye(const lenses::Lens* lens, lenses::Side side = lenses::Side::right, double amplitude = 4.0,
                const lenses::Eye& wearer = {}) {
    const std::size_t index = lenses::append_lens(model_, lens, side, wearer.entrance_pupil_depth);
    EyeOptics optics;
    optics.lens = model_.lens[index];
    optics.eye = lenses::make_eye_data(wearer, amplitude, 0.0035);
    optics.world_from_eye.position = {side == lenses::Side::right ? kHalfPd : -kHalfPd, 0.0, 0.0};
    return optics;
  }
  std::array<EyeOptics, 2> both(const lenses::Lens* lens, double amplitude = 4.0) {
    return {eye(lens, lenses::Side::right, amplitude), eye(lens, lenses::Side::left, amplitude)};
  }

  // A meniscus of this back vertex power, 27 mm before the centre of rotation.
  static lenses::Lens meniscus(double power, double decentration = 0.0) {
    lenses::Lens lens = support::meniscus(power);
    lens.fit.vertex_distance = 0.0135;
    lens.fit.decentration.x = decentration;
    return lens;
  }

  // How far the line passes from a point.
  static double miss(const LineOfSight& line, const glm::dvec3& point) {
    return glm::length(glm::cross(point - line.start, line.direction));
  }

 private:
  lenses::LensModel model_;
};

TEST_F(FixationTest, BareEyesConvergeOnAPoint) {
  const auto eyes = both(nullptr);
  for (const glm::dvec3& point :
       {glm::dvec3(0.0, 0.0, -0.4), glm::dvec3(0.3, -0.2, -0.7), glm::dvec3(-5.0, 4.0, -20.0)}) {
    const Fixation f = render::fixate(table(), eyes, Viewing::gaze, point, glm::length(point));
    EXPECT_EQ(f.line[0].point, point);
    for (const LineOfSight& line : f.line) {
      EXPECT_FALSE(line.through_lens);
      EXPECT_LE(miss(line, point), 1e-12);
      EXPECT_LE(glm::length(line.gaze - line.direction), 1e-15);
    }
  }
  // Straight ahead at 40 cm, both turn in; the pupils move in by their turn about a centre 10.45 mm behind.
  const Fixation near = render::fixate(table(), eyes, Viewing::gaze, {0.0, 0.0, -0.4}, 0.4);
  EXPECT_NEAR(std::atan(-near.line[0].gaze.x / -near.line[0].gaze.z), std::atan(kHalfPd / (0.4 + 0.01045)), 1e-12);
  EXPECT_NEAR(near.line[0].gaze.x, -near.line[1].gaze.x, 1e-15);
}

TEST_F(FixationTest, LinesReachTheTargetThroughLensesAndPrism) {
  // 5 mm of decentration in 6 D: 3 prism dioptres.
  for (const double power : {-6.0, -2.0, 2.0, 6.0}) {
    for (const double decentration : {0.0, 0.005, -0.005}) {
      const lenses::Lens lens = meniscus(power, decentration);
      const auto eyes = both(&lens);
      for (const auto viewing : {Viewing::gaze, Viewing::scanning}) {
        for (const glm::dvec3& point :
             {glm::dvec3(0.0, 0.0, -0.35), glm::dvec3(0.25, -0.2, -0.8), glm::dvec3(-2.0, 1.0, -6.0)}) {
          const Fixation f = render::fixate(table(), eyes, viewing, point, glm::length(point));
          for (const LineOfSight& line : f.line) {
            EXPECT_TRUE(line.through_lens);
            EXPECT_LE(miss(line, point), 1e-9) << power << " D, " << decentration;
          }
        }
      }
    }
  }
}

TEST_F(FixationTest, TheLineIsTheOneItsGazeGives) {
  const lenses::Lens lens = meniscus(-6.0, 0.003);
  EyeOptics optics = eye(&lens);
  optics.world_from_eye.orientation = tracking::orientation_from_yaw_pitch(0.4, -0.2);
  const glm::dvec3 target = optics.world_from_eye.point({0.2, 0.1, -0.9});
  const LineOfSight line = render::look_at(table(), optics, Viewing::gaze, target);
  const LineOfSight same = render::look_along(table(), optics, Viewing::gaze, 3.0 * line.gaze);
  EXPECT_LE(miss(line, target), 1e-9);
  EXPECT_LE(glm::length(same.start - line.start), 1e-13);
  EXPECT_LE(glm::length(same.direction - line.direction), 1e-13);
  EXPECT_NEAR(glm::length(line.direction), 1.0, 1e-15);
}

TEST_F(FixationTest, StraightCastingMissesByDegrees) {
  const glm::dvec3 gaze = tracking::direction_from_yaw_pitch(20.0 * kRadians, 0.0);
  for (const double power : {6.0, -6.0}) {
    const lenses::Lens lens = meniscus(power);
    const LineOfSight line = render::look_along(table(), eye(&lens), Viewing::gaze, gaze);
    ASSERT_TRUE(line.through_lens);
    const double error = std::acos(glm::dot(line.direction, gaze)) / kRadians;
    // Prentice: 27 mm tan 20 = 9.8 mm, times 6 D: 5.9 prism dioptres, 3.4 degrees; a thick plus lens adds to that.
    EXPECT_NEAR(error, power > 0.0 ? 4.0 : 3.4, 0.1);
    // A plus lens bends the line toward its axis, a minus lens away from it.
    EXPECT_GT(power * (gaze.x - line.direction.x), 0.0);
  }
}

TEST_F(FixationTest, BesideTheLensTheLineIsStraight) {
  lenses::Lens lens = meniscus(-6.0);
  lens.diameter = 0.02;
  const glm::dvec3 point(1.5, 0.0, -1.0);
  const LineOfSight line = render::look_at(table(), eye(&lens), Viewing::gaze, point);
  EXPECT_FALSE(line.through_lens);
  EXPECT_LE(miss(line, point), 1e-12);
}

TEST_F(FixationTest, BothEyesTakeTheLesserDemand) {
  // The right eye is 2 D short-sighted, so it asks for less at 40 cm.
  lenses::Eye myope;
  myope.power = lenses::Refraction{-2.0, 0.0, 0.0};
  const std::array<EyeOptics, 2> eyes{eye(nullptr, lenses::Side::right, 5.0, myope),
                                      eye(nullptr, lenses::Side::left, 5.0)};
  const glm::dvec3 point(0.0, 0.0, -0.4);
  const Fixation f = render::fixate(table(), eyes, Viewing::gaze, point, 0.4);
  // From the turned pupil, 1.1 mm and less nearer or farther than 40 cm.
  const double q = 1.0 / glm::length(point - f.line[1].start);
  EXPECT_NEAR(f.demand[1], q, 1e-12);
  // -2 D at the spectacle plane is -2/(1 + 2 d) at the pupil, d = 16.05 mm.
  EXPECT_NEAR(f.demand[0], 1.0 / glm::length(point - f.line[0].start) - 2.0 / (1.0 + 2.0 * 0.01605), 1e-12);
  EXPECT_EQ(f.accommodation[0], f.demand[0]);
  EXPECT_EQ(f.accommodation[1], f.demand[0]);
}

TEST_F(FixationTest, AccommodationIsLimitedEyeByEye) {
  const std::array<EyeOptics, 2> eyes{eye(nullptr, lenses::Side::right, 1.0), eye(nullptr, lenses::Side::left, 8.0)};
  const Fixation near = render::fixate(table(), eyes, Viewing::gaze, {0.0, 0.0, -0.25}, 0.25);
  EXPECT_EQ(near.accommodation[0], 1.0);
  EXPECT_NEAR(near.accommodation[1], std::min(near.demand[0], near.demand[1]), 1e-15);
  EXPECT_GT(near.accommodation[1], 3.5);

  // A long-sighted lens that asks for negative power: the eyes rest.
  const lenses::Lens strong = meniscus(6.0);
  const Fixation far = render::fixate(table(), both(&strong), Viewing::gaze, {0.0, 0.0, -50.0}, 50.0);
  EXPECT_LT(far.demand[0], 0.0);
  EXPECT_EQ(far.accommodation[0], 0.0);
  EXPECT_EQ(far.accommodation[1], 0.0);
}

TEST_F(FixationTest, GazeFindsWhatBothEyesSee) {
  render::Scene scene;
  for (const glm::vec3& p : {glm::vec3(-50, -50, -2), glm::vec3(50, -50, -2), glm::vec3(0, 90, -2)}) {
    scene.vertices.push_back({p, {0, 0, 1}, {0, 0}});
  }
  scene.triangles.emplace_back(0U, 1U, 2U);
  scene.triangle_material.push_back(0);
  scene.materials.emplace_back();
  const render::RayQuery query(scene);
  const lenses::Lens lens = meniscus(-4.0);
  const auto eyes = both(&lens);
  const Fixation f =
      render::fixate_along(table(), eyes, Viewing::gaze, tracking::direction_from_yaw_pitch(0.15, 0.1), query);
  EXPECT_NEAR(f.line[0].point.z, -2.0, 1e-5);
  for (const LineOfSight& line : f.line) {
    EXPECT_TRUE(line.through_lens);
    EXPECT_LE(miss(line, line.point), 1e-9);
  }
  const Fixation sky = render::fixate_along(table(), eyes, Viewing::gaze, tracking::direction_from_yaw_pitch(0.0, 1.0),
                                            render::RayQuery(render::Scene{}));
  EXPECT_TRUE(std::isinf(sky.distance));
  // A lens of -4 D at its vertex, a point as good as infinity: 3.76 D at the pupil.
  const Fixation ahead =
      render::fixate_along(table(), eyes, Viewing::gaze, {0.0, 0.0, -1.0}, render::RayQuery(render::Scene{}));
  EXPECT_NEAR(ahead.demand[0], 4.0 / (1.0 + 4.0 * 0.01655), 1e-5);
}

}  // namespace
