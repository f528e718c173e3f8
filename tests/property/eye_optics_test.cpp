// The eye: Listing's rotation, the closed-form power of a lens at its vertex, the blur ellipse, accommodation.
#include <gtest/gtest.h>

#include "tests/support/random_lens.hpp"
#include "tests/support/sight.hpp"
#include "tracking/stereo_view.hpp"

namespace {

using support::Random;
using support::Sight;
namespace f64 = lenses::f64;

constexpr std::uint64_t kSeed = 18661845;

void expect_listing_rotation(const glm::dmat3& turn, const glm::dvec3& gaze) {
  // A gaze near straight back divides by its small distance from there.
  const double rounding = 1e-14 + 1e-15 / (1.0 - gaze.z);
  const glm::dmat3 one = glm::transpose(turn) * turn - glm::dmat3(1.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LE(glm::length(one[i]), rounding);
  }
  EXPECT_NEAR(glm::determinant(turn), 1.0, rounding);
  EXPECT_LE(glm::length(turn * glm::dvec3(0.0, 0.0, -1.0) - gaze), 1e-14);
  // No torsion: the axis lies in Listing's plane, across the primary gaze.
  EXPECT_NEAR(turn[0][1], turn[1][0], rounding);
  // The smallest rotation: its angle is the angle between the two gazes.
  const double cosine = 0.5 * (turn[0][0] + turn[1][1] + turn[2][2] - 1.0);
  EXPECT_NEAR(cosine, -gaze.z, rounding);
}

TEST(ListingRotation, IsTheSmallestAndHasNoTorsion) {
  Random random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 gaze = random.direction_ahead(i % 2 == 0 ? 0.9 : 3.1);
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", gaze " << i);
    expect_listing_rotation(f64::listing_rotation(gaze), gaze);
    expect_listing_rotation(tracking::listing_rotation(gaze * random.log_uniform(1e-3, 1e3)), gaze);
  }
  expect_listing_rotation(f64::listing_rotation({0.0, 0.0, -1.0}), {0.0, 0.0, -1.0});
}

// A yaw and then a pitch would leave 8 degrees of torsion at 30/30 degrees.
TEST(ListingRotation, DiffersFromYawThenPitchAtTertiaryGaze) {
  const double angle = 30.0 * support::kRadians;
  const glm::dvec3 gaze = tracking::direction_from_yaw_pitch(angle, angle);
  const glm::dmat3 listing = tracking::listing_rotation(gaze);
  const glm::dmat3 helmholtz = glm::mat3_cast(tracking::orientation_from_yaw_pitch(angle, angle));
  const glm::dvec3 up = glm::transpose(listing) * helmholtz[1];
  const double torsion = std::atan2(-up.x, up.y) / support::kRadians;
  EXPECT_NEAR(std::abs(torsion), 8.2, 0.1);  // 2 atan(tan 15 tan 15): 8.21 degrees
}

TEST(VertexPower, AgreesWithTheThickLensFormula) {
  Random random(kSeed);
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", lens " << i);
    lenses::TraceRequest request;
    lenses::Lens lens = support::ordinary_lens(random, 1, 1);
    lens.fit.decentration = glm::dvec2(0.0);
    lens.fit.pantoscopic_tilt = 0.0;
    lens.fit.wrap = 0.0;
    request.lens = lens;
    if (i % 2 == 0) {
      request.object_distance = random.log_uniform(0.2, 50.0);
    }
    const Sight sight(request);
    ASSERT_TRUE(sight.ok());
    const double n = lens.index;
    const double front = (n - 1.0) * std::get<lenses::Sphere>(lens.front).curvature;
    const double back = (1.0 - n) * std::get<lenses::Sphere>(lens.back).curvature;
    const double after_front = front - (request.object_distance ? 1.0 / *request.object_distance : 0.0);
    const double at_vertex = after_front / (1.0 - lens.centre_thickness / n * after_front) + back;
    const double distance = lens.fit.vertex_distance + request.eye.entrance_pupil_depth;
    const double at_pupil = at_vertex / (1.0 - distance * at_vertex);
    EXPECT_NEAR(sight.result.vergence.x, at_pupil, 1e-11);
    EXPECT_NEAR(sight.result.vergence.z, at_pupil, 1e-11);
    EXPECT_NEAR(sight.result.vergence.y, 0.0, 1e-13);
    EXPECT_LE(sight.result.deviation, 1e-15);
  }
}

f64::EyeData random_eye(Random& random) {
  f64::EyeData eye{};
  eye.excess = {random.uniform(-6.0, 6.0), random.uniform(-2.0, 2.0), random.uniform(-6.0, 6.0), 4.0};
  eye.pupil = {random.uniform(0.001, 0.008), 0.01, 0.0, 0.0};
  return eye;
}

// The eye sends the rim of its pupil to the angles R s: all of them lie on the ellipse.
TEST(BlurEllipse, HoldsTheImageOfThePupilsRim) {
  Random random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", eye " << i);
    const f64::EyeData eye = random_eye(random);
    const glm::dvec3 v(random.uniform(-9.0, 9.0), random.uniform(-3.0, 3.0), random.uniform(-9.0, 9.0));
    const f64::EyeResponse r = f64::eye_response(v, eye, random.uniform(0.0, 4.0));
    ASSERT_GE(r.blur.x, r.blur.y);
    const glm::dvec2 major(std::cos(r.blur_axis), std::sin(r.blur_axis));
    const glm::dvec2 minor(-major.y, major.x);
    const glm::dmat2 residual(r.residual.x, r.residual.y, r.residual.y, r.residual.z);
    for (int k = 0; k < 12; ++k) {
      const double angle = 0.5 * k;
      const glm::dvec2 spot = 0.5 * eye.pupil.x * (residual * glm::dvec2(std::cos(angle), std::sin(angle)));
      const double along = glm::dot(spot, major);
      const double across = glm::dot(spot, minor);
      // (along/major)^2 + (across/minor)^2 = 1, multiplied out, so that a line-shaped blur is no special case.
      const double left = along * along * r.blur.y * r.blur.y + across * across * r.blur.x * r.blur.x;
      const double right = r.blur.x * r.blur.x * r.blur.y * r.blur.y;
      EXPECT_NEAR(left, right, 1e-14 * std::pow(r.blur.x, 4));
    }
  }
}

TEST(BlurEllipse, OfCrossedAstigmatismIsNotZero) {
  f64::EyeData eye{};
  eye.pupil.x = 0.004;
  // 1 D of lens astigmatism at 45 degrees, mean defocus 0: the eye's own lines see none of it.
  const f64::EyeResponse r = f64::eye_response({0.0, 0.5, 0.0}, eye, 0.0);
  EXPECT_NEAR(r.blur.x, 0.001, 1e-16);
  EXPECT_NEAR(r.blur.y, 0.001, 1e-16);
}

TEST(Accommodation, BringsTheMeanResidualToZeroWithinItsAmplitude) {
  Random random(kSeed);
  for (int i = 0; i < 1000; ++i) {
    const f64::EyeData eye = random_eye(random);
    const glm::dvec3 v(random.uniform(-9.0, 9.0), random.uniform(-3.0, 3.0), random.uniform(-9.0, 9.0));
    const double used = f64::clamped_accommodation(v, eye);
    const f64::EyeResponse r = f64::eye_response(v, eye, used);
    const double mean = 0.5 * (r.residual.x + r.residual.z);
    EXPECT_GE(used, 0.0);
    EXPECT_LE(used, eye.excess.w);
    if (used == 0.0) {
      EXPECT_GE(mean, -1e-14);  // more power would only blur
    } else if (used == eye.excess.w) {
      EXPECT_LE(mean, 1e-14);
    } else {
      EXPECT_NEAR(mean, 0.0, 1e-14);
    }
  }
}

}  // namespace
