// Lenses shaped for their position of wear, and what the eye gets through a worn lens.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lenses/design/prescription_lens.hpp"
#include "lenses/design/worn_power.hpp"

namespace {

using lenses::DesignedLens;
using lenses::LensDesign;
using lenses::LensRequest;
using lenses::Prescription;
namespace design = lenses::design;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr double kIndex = 1.498;

LensRequest order(Prescription p, LensDesign kind = LensDesign::single_vision) {
  LensRequest request;
  request.prescription = std::move(p);
  request.design = kind;
  return request;
}

// Golden values of a table of four lenses are of the turned eye; here the lens is turned about the eye's centre
// instead, and the eye looks straight ahead: 30 degrees, 27 mm behind the back vertex.
TEST(WornPower, OfALensTurnedAboutTheEyesCentreIsThatOfTheTurnedEye) {
  constexpr double kTurn = 30.0 * kDegree;
  constexpr double kVertexSphere = 0.027;
  lenses::Lens lens;
  lens.index = 1.498;
  lens.centre_thickness = 0.0045;
  lens.diameter = 0.08;
  lens.front = lenses::Sphere{8.0 / 0.498};
  lens.back = lenses::Sphere{(4.0 - 8.0 / (1.0 - 0.0045 * 8.0 / 1.498)) / (1.0 - 1.498)};
  const double rotation_depth = 0.0135;
  lens.fit = {.vertex_distance = kVertexSphere * std::cos(kTurn) - rotation_depth,
              .decentration = {0.0, -kVertexSphere * std::sin(kTurn)},
              .pantoscopic_tilt = kTurn};
  design::WornSetup setup;
  setup.reference_vertex = kVertexSphere - rotation_depth;
  const auto worn = design::worn_power_along(lens, setup, {0.0, 0.0, -1.0});
  ASSERT_TRUE(worn);
  constexpr double kRounding = 5e-5 + 1e-7;  // of the fourth decimal
  EXPECT_NEAR(worn->power[1][1], 4.0364, kRounding);
  EXPECT_NEAR(worn->power[0][0], 3.8684, kRounding);
}

// Martin's tilt: S (1 + sin^2 a / 2n) and an induced cylinder S tan^2 a about the axis of the tilt, for a thin lens.
TEST(AsWorn, CompensatesTiltAsMartinsFormulaSays) {
  LensRequest request = order({-6.0, 0.0, 0.0, 0.0, {}});
  request.as_worn = true;
  request.fit.pantoscopic_tilt = 15.0 * kDegree;
  request.fit.wrap = 0.0;
  const DesignedLens d = lenses::design_lens(request);
  EXPECT_NEAR(d.worn->sphere, -6.0, 1e-6);
  EXPECT_NEAR(d.worn->cylinder, 0.0, 1e-6);
  EXPECT_TRUE(d.worn->prism.empty() || d.worn->prism[0].magnitude < 1e-6);
  const double s2 = std::pow(std::sin(15.0 * kDegree), 2);
  const double t2 = std::pow(std::tan(15.0 * kDegree), 2);
  const double sphere = -6.0 / (1.0 + s2 / (2.0 * kIndex));
  // Third-order theory of a thin lens against a real one: a tenth of what the tilt does.
  EXPECT_NEAR(d.verification.sphere + 0.5 * d.verification.cylinder, sphere * (1.0 - 0.5 * t2), 0.1 * 6.0 * t2);
  EXPECT_NEAR(std::abs(d.verification.cylinder), 6.0 * t2, 0.15 * 6.0 * t2);
  ASSERT_TRUE(d.lens.order && d.lens.order->compensated);
  EXPECT_EQ(d.lens.order->ordered.sphere, -6.0);
  EXPECT_NEAR(d.lens.order->compensated->cylinder, d.verification.cylinder, 1e-12);
}

TEST(AsWorn, MovesThePowerToTheWornVertex) {
  LensRequest request = order({10.0, 0.0, 0.0, 0.0, {}});
  request.as_worn = true;
  request.fit = {.vertex_distance = 0.016};
  const DesignedLens d = lenses::design_lens(request);
  // 3 mm farther from the eye than where the eye was refracted: F / (1 + d F).
  EXPECT_NEAR(d.verification.sphere, 10.0 / (1.0 + 0.003 * 10.0), 1e-6);
}

TEST(AsWorn, ALensNobodySeesThroughIsMadeAllTheSame) {
  LensRequest request = order({2.0, 0.0, 0.0, 0.0, {}});
  request.fit.decentration.x = 0.05;
  request.fit.wrap = -60.0 * kDegree;
  request.diameter = 0.04;
  const DesignedLens d = lenses::design_lens(request);
  EXPECT_NEAR(d.verification.sphere, 2.0, 1e-9);
}

TEST(AsWorn, HoldsForEveryDesign) {
  for (const LensDesign kind : {LensDesign::single_vision, LensDesign::bifocal, LensDesign::progressive}) {
    LensRequest request = order({2.5, -1.75, 160.0 * kDegree, 0.0, {{1.0, 0.5 * kPi}}}, kind);
    request.prescription.addition = kind == LensDesign::single_vision ? 0.0 : 2.0;
    request.as_worn = true;
    request.side = lenses::Side::left;
    const DesignedLens d = lenses::design_lens(request);
    EXPECT_NEAR(d.worn->sphere, 2.5, 1e-6);
    EXPECT_NEAR(d.worn->cylinder, -1.75, 1e-6);
    EXPECT_NEAR(d.worn->axis, 160.0 * kDegree, 1e-6);
    ASSERT_EQ(d.worn->prism.size(), 1U);
    EXPECT_NEAR(d.worn->prism[0].magnitude, 1.0, 1e-6);
    EXPECT_GT(std::abs(d.verification.sphere - 2.5), 0.01) << "and the lensmeter reads something else";
  }
}

}  // namespace
