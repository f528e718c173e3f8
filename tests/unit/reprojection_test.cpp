// The error of a reprojection that takes a lens on the head for a part of the world, against the tracer itself.
#include "lenses/reprojection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "lenses/lens_model.hpp"
#include "tests/support/random_lens.hpp"

namespace {

namespace f64 = lenses::f64;
using support::kRadians;

constexpr double kPupil = 0.00305;

class ReprojectionTest : public testing::Test {
 protected:
  void wear(const lenses::Lens* lens) {
    model_ = {};
    static_cast<void>(lenses::append_lens(model_, lens, lenses::Side::right, kPupil));
  }
  [[nodiscard]] const f64::LensData& lens() const { return model_.lens.front(); }
  [[nodiscard]] f64::SightLine sight(const glm::dvec3& direction) const {
    return f64::trace_sight_line(f64::Table{model_.table}, lens(), eye_, glm::dmat3(1.0), glm::normalize(direction),
                                 glm::dvec2(0.0), glm::dvec2(0.0));
  }

  // By the tracer alone: what the reprojected picture shows at h is the world's direction that the lens gave for the
  // pixel turned by the head's turn; which direction would show it now?
  [[nodiscard]] glm::dvec2 traced(const glm::dvec3& h, const glm::dvec3& turn) const {
    const glm::dquat head = glm::angleAxis(glm::length(turn), glm::normalize(turn));
    const glm::dvec3 shown = sight(head * h).direction_object;
    glm::dvec3 direction = h;
    for (int i = 0; i < 60; ++i) {
      direction = glm::normalize(direction + glm::conjugate(head) * shown - sight(direction).direction_object);
    }
    const f64::SightLine line = sight(h);
    return {glm::dot(direction - h, line.e_h), glm::dot(direction - h, line.e_v)};
  }

  static lenses::Lens sphere(double power) {
    lenses::Lens lens;
    lens.index = 1.5;
    lens.centre_thickness = 1e-5;
    lens.diameter = 0.07;
    lens.front = lenses::Sphere{0.0};
    lens.back = lenses::Sphere{-power / 0.5};
    return lens;
  }

 private:
  lenses::LensModel model_;
  f64::EyeData eye_ = lenses::make_eye_data({}, 0.0, 0.0035);
};

TEST_F(ReprojectionTest, OnAxisItIsTheThinLensFormula) {
  const double distance = 0.013 + kPupil;
  const double turn = 2.0 * kRadians;  // 100 deg/s for 20 ms
  for (const double power : {-8.0, -2.0, 4.0, 8.0}) {
    const lenses::Lens lens = sphere(power);
    wear(&lens);
    const glm::dvec2 error = lenses::reprojection_error(this->lens(), sight({0.0, 0.0, -1.0}), {0.0, -turn, 0.0});
    const double thin = lenses::thin_lens_reprojection_error(power, distance, turn);
    // A lens 10 um thick is a thin one but for that thickness.
    EXPECT_NEAR(std::abs(error.x), std::abs(thin), 2e-3 * std::abs(thin)) << power;
    EXPECT_NEAR(error.y, 0.0, 1e-15);
    // A turn to the right: e_h is +x. Through a plus lens what is shown belongs to the left of where it stands.
    EXPECT_LT(error.x * power, 0.0) << power;
  }
  // 6 D at 16 mm, 2 deg: 0.21 deg, which is 4.3 px of 20 a degree.
  EXPECT_NEAR(lenses::thin_lens_reprojection_error(6.0, distance, turn) / kRadians, 0.213, 1e-3);
}

TEST_F(ReprojectionTest, EverywhereItIsWhatTheTracerSays) {
  support::Random random(41);
  for (int i = 0; i < 40; ++i) {
    lenses::Lens lens = sphere(random.uniform(-8.0, 6.0));
    lens.centre_thickness = 0.006;
    lens.front = lenses::Torus{random.uniform(2.0, 9.0), random.uniform(2.0, 9.0), random.uniform(0.0, 3.0)};
    lens.fit.pantoscopic_tilt = random.uniform(-0.2, 0.2);
    lens.fit.wrap = random.uniform(-0.2, 0.2);
    lens.fit.decentration = {random.uniform(-0.005, 0.005), random.uniform(-0.005, 0.005)};
    wear(&lens);
    const glm::dvec3 h = random.direction_ahead(25.0 * kRadians);
    if (sight(h).status != f64::kStatusOk) {
      continue;
    }
    // Small enough for first order, all axes, roll among them.
    const glm::dvec3 turn = 1e-5 * random.direction();
    const glm::dvec2 expected = traced(h, turn);
    const glm::dvec2 error = lenses::reprojection_error(this->lens(), sight(h), turn);
    // The turn's square, and the lens's curvature of field over it.
    EXPECT_LE(glm::length(error - expected), 1e-8) << "seed 41, lens " << i << ": " << expected.x << " " << expected.y;
    EXPECT_GT(glm::length(expected), 1e-9);
  }
}

TEST_F(ReprojectionTest, ABareEyeAndAPlaneGlassHaveNone) {
  wear(nullptr);
  EXPECT_EQ(lenses::reprojection_error(lens(), sight({0.1, 0.0, -1.0}), {0.1, 0.2, 0.3}), glm::dvec2(0.0));
  const lenses::Lens plane = sphere(0.0);
  wear(&plane);
  EXPECT_LE(glm::length(lenses::reprojection_error(lens(), sight({0.1, 0.2, -1.0}), {0.1, 0.2, 0.3})), 1e-12);
}

}  // namespace
