// Lenses made from prescriptions against the closed forms of geometrical optics.
#include "lenses/design/prescription_lens.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lenses/design/lens_shape.hpp"
#include "lenses/design/surface_making.hpp"
#include "lenses/design/worn_power.hpp"

namespace {

using lenses::DesignedLens;
using lenses::DesignError;
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

double radius_of(const lenses::Surface& surface) {
  return 1.0 / std::get<lenses::Sphere>(surface).curvature;
}

// Sag of a sphere.
double sag(double radius, double height) {
  return radius - std::copysign(std::sqrt(radius * radius - height * height), radius);
}

void expect_refused(const LensRequest& request, const std::string& field, const std::string& word) {
  try {
    (void)lenses::design_lens(request);
    ADD_FAILURE() << "not refused; wanted " << field;
  } catch (const DesignError& error) {
    EXPECT_EQ(error.field(), field) << error.what();
    EXPECT_NE(error.reason().find(word), std::string::npos) << "wanted '" << word << "' in: " << error.reason();
  }
}

// Back vertex power F1 / (1 - t F1 / n) + F2, the base curve by Vogel's rule, the minimum centre thickness.
TEST(SingleVision, MinusLensIsTheThickLensFormulas) {
  const DesignedLens d = lenses::design_lens(order({-4.0, 0.0, 0.0, 0.0, {}}));
  EXPECT_DOUBLE_EQ(d.base_curve, 4.0);
  EXPECT_DOUBLE_EQ(d.lens.centre_thickness, 0.0012);
  EXPECT_DOUBLE_EQ(d.lens.diameter, 0.065);
  EXPECT_NEAR(radius_of(d.lens.front), (kIndex - 1.0) / 4.0, 1e-15);
  const double f2 = -4.0 - 4.0 / (1.0 - 0.0012 * 4.0 / kIndex);
  EXPECT_NEAR(radius_of(d.lens.back), (1.0 - kIndex) / f2, 1e-12);
}

// The edge is what the plus lens is thin at; its centre follows from the sags.
TEST(SingleVision, PlusLensIsAsThinAsItsEdgeAllows) {
  const DesignedLens d = lenses::design_lens(order({4.0, 0.0, 0.0, 0.0, {}}));
  EXPECT_DOUBLE_EQ(d.base_curve, 10.0);
  const double edge =
      d.lens.centre_thickness + sag(radius_of(d.lens.back), 0.0325) - sag(radius_of(d.lens.front), 0.0325);
  EXPECT_NEAR(edge, 0.001, 2e-8);  // to which the thickness is sought
  EXPECT_NEAR(d.thinnest_edge, edge, 1e-9);
  EXPECT_NEAR(d.thickest_edge, edge, 1e-9);
}

TEST(SingleVision, OutlineDecidesTheThicknessOfAPlusLens) {
  LensRequest request = order({4.0, 0.0, 0.0, 0.0, {}});
  const double round = lenses::design_lens(request).lens.centre_thickness;
  request.outline = {{0.025, 0.015}, {-0.02, 0.015}, {-0.02, -0.015}, {0.025, -0.015}};
  const DesignedLens d = lenses::design_lens(request);
  EXPECT_LT(d.lens.centre_thickness, round);
  EXPECT_NEAR(d.lens.diameter, 2.0 * std::hypot(0.025, 0.015), 1e-9);
  // Thinnest at the far corners.
  const double corner = std::hypot(0.025, 0.015);
  EXPECT_NEAR(d.lens.centre_thickness + sag(radius_of(d.lens.back), corner) - sag(radius_of(d.lens.front), corner),
              0.001, 2e-8);
  EXPECT_EQ(d.lens.outline, request.outline);
}

TEST(SingleVision, VogelsRule) {
  EXPECT_DOUBLE_EQ(design::vogel_base_curve(3.0), 9.0);
  EXPECT_DOUBLE_EQ(design::vogel_base_curve(-4.0), 4.0);
  EXPECT_DOUBLE_EQ(design::vogel_base_curve(-14.0), 0.5);
}

// min(65 mm, 1.8 times the smallest radius).
TEST(SingleVision, SteepSurfacesMakeASmallLens) {
  const DesignedLens d = lenses::design_lens(order({-18.0, 0.0, 0.0, 0.0, {}}));
  const double smallest = radius_of(d.lens.back);
  EXPECT_LE(d.lens.diameter, 1.8 * smallest);
  EXPECT_GT(d.lens.diameter, 1.8 * smallest - 2e-4) << "rounded down to a tenth of a millimetre, no more";
}

// A cylinder of either sign: the back's two sections each make their meridian's power.
TEST(SingleVision, ToricBackHasThePowerOfEachMeridian) {
  for (const auto form : {lenses::ToricForm::tyre, lenses::ToricForm::barrel}) {
    LensRequest request = order({-1.0, -2.0, 30.0 * kDegree, 0.0, {}});
    request.toric = form;
    const DesignedLens d = lenses::design_lens(request);
    const auto& torus = std::get<lenses::Torus>(d.lens.back);
    const double base = d.base_curve / (1.0 - d.lens.centre_thickness * d.base_curve / kIndex);
    const double flat = (base + 1.0) / (kIndex - 1.0);
    const double steep = (base + 3.0) / (kIndex - 1.0);
    EXPECT_EQ(torus.revolve, lenses::Torus::Revolve::u);
    // The arc of v is turned: the steeper one on a tyre.
    const bool tyre = form == lenses::ToricForm::tyre;
    EXPECT_NEAR(torus.curvature_v, tyre ? steep : flat, 1e-9);
    EXPECT_NEAR(torus.curvature_u, tyre ? flat : steep, 1e-9);
    // The sphere's power lies along the axis: 30 degrees to the examiner, 150 to the wearer.
    EXPECT_NEAR(torus.axis, (tyre ? 150.0 : 60.0) * kDegree, 1e-9);
  }
}

TEST(SingleVision, TransposedOrdersMakeOneLens) {
  const DesignedLens minus = lenses::design_lens(order({2.0, -3.0, 20.0 * kDegree, 0.0, {}}));
  const DesignedLens plus = lenses::design_lens(order({-1.0, 3.0, 110.0 * kDegree, 0.0, {}}));
  const auto& a = std::get<lenses::Torus>(minus.lens.back);
  const auto& b = std::get<lenses::Torus>(plus.lens.back);
  EXPECT_NEAR(a.curvature_u, b.curvature_u, 1e-9);
  EXPECT_NEAR(a.curvature_v, b.curvature_v, 1e-9);
  EXPECT_NEAR(a.axis, b.axis, 1e-9);
  EXPECT_NEAR(plus.verification.cylinder, 3.0, 1e-9) << "reported with the sign it was ordered with";
}

TEST(SingleVision, AsphericFrontHasLessObliqueError) {
  LensRequest request = order({4.0, 0.0, 0.0, 0.0, {}});
  request.base_curve = 7.0;
  request.fit.pantoscopic_tilt = request.fit.wrap = 0.0;
  const auto error = [](const lenses::Lens& lens) {
    double sum = 0.0;
    for (const double turn : {15.0, 25.0, 35.0}) {
      const auto worn = design::worn_power_along(lens, {}, {0.0, std::sin(turn * kDegree), -std::cos(turn * kDegree)});
      sum += worn ? std::pow(worn->power[0][0] - 4.0, 2) + std::pow(worn->power[1][1] - 4.0, 2) : 1e9;
    }
    return std::sqrt(sum);
  };
  const DesignedLens sphere = lenses::design_lens(request);
  request.front = lenses::FrontDesign::aspheric;
  const DesignedLens asphere = lenses::design_lens(request);
  EXPECT_LT(error(asphere.lens), 0.7 * error(sphere.lens));
  EXPECT_LT(asphere.lens.centre_thickness, sphere.lens.centre_thickness) << "flatter towards the edge";
  EXPECT_NEAR(asphere.verification.sphere, 4.0, 1e-9);
}

// A plano prism's front is inclined by w with n sin w = sin(w + deviation).
TEST(Prism, ByTiltIsSnellsLaw) {
  LensRequest request = order({0.0, 0.0, 0.0, 0.0, {{6.0, 0.0}}});
  request.base_curve = 0.0;
  const DesignedLens d = lenses::design_lens(request);
  const double deviation = std::atan(0.06);
  // n sin w = sin(w + deviation)
  const double w = std::atan2(std::sin(deviation), kIndex - std::cos(deviation));
  // Base 0 to the examiner is towards the wearer's left: the front leaves the eye there, -z at -x.
  EXPECT_NEAR(d.lens.front_placement.slope.x, std::tan(w), 1e-9);
  EXPECT_NEAR(d.lens.front_placement.slope.y, 0.0, 1e-12);
  const design::LensShape shape(d.lens);
  EXPECT_GT(*shape.thickness({-0.02, 0.0}), *shape.thickness({0.02, 0.0})) << "the base is where the glass is thick";
}

TEST(Prism, ByTiltTurnsASphereAboutItsOwnCentre) {
  const DesignedLens d = lenses::design_lens(order({2.0, 0.0, 0.0, 0.0, {{3.0, 0.5 * kPi}}}));
  EXPECT_EQ(d.lens.front_placement.slope, glm::dvec2(0.0));
  // Seen from the lens axis the front leans towards the base, up.
  EXPECT_GT(d.lens.front_placement.decentration.y, 0.0);
  EXPECT_NEAR(design::LensShape(d.lens).front({0.0, 0.0}).z, -d.lens.centre_thickness, 1e-15);
}

// Prentice: the optical centre lies towards the base by P / F.
TEST(Prism, ByDecentrationIsPrenticesRule) {
  LensRequest request = order({-5.0, 0.0, 0.0, 0.0, {{1.5, 0.0}}});
  request.prism_by = lenses::PrismBy::decentration;
  const DesignedLens d = lenses::design_lens(request);
  EXPECT_EQ(d.lens.front_placement.decentration, d.lens.back_placement.decentration);
  // Base to the wearer's left; a minus lens's centre lies away from the base. The rule is for thin lenses: 2 %.
  EXPECT_NEAR(d.lens.front_placement.decentration.x, 0.003, 0.02 * 0.003);
  ASSERT_EQ(d.verification.prism.size(), 1U);
  EXPECT_NEAR(d.verification.prism[0].magnitude, 1.5, 1e-9);
}

TEST(Prism, ByDecentrationNeedsPower) {
  LensRequest request = order({0.25, 0.0, 0.0, 0.0, {{2.0, 0.0}}});
  request.prism_by = lenses::PrismBy::decentration;
  expect_refused(request, "prism_by", "80 mm");
  request.prescription.sphere = 0.0;
  expect_refused(request, "prism_by", "tilt always is");
}

TEST(Contact, TakesItsPowerAtTheCornea) {
  LensRequest request = order({-8.0, 0.0, 0.0, 0.0, {}}, LensDesign::contact);
  lenses::set_contact_material(request);
  const DesignedLens d = lenses::design_lens(request);
  EXPECT_NEAR(d.verification.sphere, -8.0 / (1.0 + 8.0 * 0.013), 1e-9);
  EXPECT_EQ(d.lens.attached_to, lenses::Lens::AttachedTo::eye);
  EXPECT_EQ(d.lens.fit.vertex_distance, 0.0);
  EXPECT_NEAR(radius_of(d.lens.back), 0.0086, 1e-15);
  EXPECT_NEAR(d.lens.centre_thickness, 0.00008, 1e-15);
  // The eye gets what it was refracted for at the spectacle plane.
  EXPECT_NEAR(d.worn->sphere, -8.0, 1e-9);
  ASSERT_TRUE(d.lens.order && d.lens.order->compensated);
  EXPECT_EQ(d.lens.order->ordered.sphere, -8.0);
  EXPECT_NEAR(d.lens.order->compensated->sphere, d.verification.sphere, 1e-12);
}

TEST(Contact, RigidLensAndARefractionOnTheCornea) {
  LensRequest request = order({3.0, -1.0, 0.5 * kPi, 0.0, {}}, LensDesign::contact);
  request.contact = lenses::ContactKind::rigid;
  request.refraction_vertex = 0.0;
  const DesignedLens d = lenses::design_lens(request);
  EXPECT_NEAR(radius_of(d.lens.back), 0.0078, 1e-15);
  EXPECT_GE(d.lens.centre_thickness, 0.00014);
  EXPECT_NEAR(d.verification.sphere, 3.0, 1e-9);
  EXPECT_NEAR(d.verification.cylinder, -1.0, 1e-9);
}

TEST(Progressive, IsReadAsOrderedOnEitherSideOfTheLens) {
  for (const auto face : {lenses::ProgressiveConfig::Face::eye_side, lenses::ProgressiveConfig::Face::front}) {
    LensRequest request = order({-3.0, -1.25, 75.0 * kDegree, 2.0, {}}, LensDesign::progressive);
    request.progressive_face = face;
    request.prism_thinning = true;
    const DesignedLens d = lenses::design_lens(request);
    EXPECT_NEAR(d.verification.sphere, -3.0, 1e-6);
    EXPECT_NEAR(d.verification.cylinder, -1.25, 1e-6);
    EXPECT_NEAR(d.verification.axis, 75.0 * kDegree, 1e-6);
    // Thinning: two thirds of the addition, base down.
    ASSERT_EQ(d.verification.prism.size(), 1U);
    EXPECT_NEAR(d.verification.prism[0].magnitude, 2.0 * 2.0 / 3.0, 1e-6);
    EXPECT_NEAR(d.verification.prism[0].base, 1.5 * kPi, 1e-6);
    EXPECT_EQ(d.lens.fit.decentration, -*d.lens.reference_points.fitting_cross) << "the cross goes to the pupil";
    // The addition, read on the progressive's own side.
    const design::LensShape shape(d.lens);
    const bool front = face == lenses::ProgressiveConfig::Face::front;
    const auto read = front ? design::reading_at_front : design::reading_at_back;
    const auto mean = [&](const glm::dvec2& p) {
      const auto reading = read(shape, p);
      return reading ? 0.5 * (reading->power[0][0] + reading->power[1][1]) : 0.0;
    };
    // Below what any lensmeter shows.
    EXPECT_NEAR(mean(*d.lens.reference_points.near) - mean(*d.lens.reference_points.distance), 2.0, 0.005);
    // The front's mean power, for the cylinder there or not; the surface's own error and slope are in it.
    const glm::dvec3 bend = shape.front({0.0, 0.008}).hessian;
    EXPECT_NEAR(0.5 * (bend.x + bend.z) * (kIndex - 1.0), d.base_curve, 0.15);
  }
}

TEST(Refusals, SayWhatIsWrongAndWhatIsPossible) {
  LensRequest request = order({12.0, 0.0, 0.0, 0.0, {}});
  request.diameter = 0.09;
  expect_refused(request, "diameter_mm", "at most 49.8");
  request.diameter.reset();
  request.outline = {{0.04, 0.0}, {0.0, 0.02}, {-0.04, 0.0}, {0.0, -0.02}};
  expect_refused(request, "outline", "across");
  request.outline.clear();
  request.centre_thickness = 0.003;
  expect_refused(request, "centre_thickness_mm", "at least");
  expect_refused(order({-40.0, -20.0, 0.0, 0.0, {}}), "prescription.sphere", "-40");
  expect_refused(order({1.0, 0.0, 0.0, 2.0, {}}), "prescription.add", "bifocal or progressive");
  expect_refused(order({1.0, 0.0, 0.0, 0.0, {}}, LensDesign::bifocal), "prescription.add", "0.25");
  expect_refused(order({1.0, 0.0, 0.0, 0.0, {}}, LensDesign::progressive), "prescription.add", "0.75");
  expect_refused(order({0.0, 0.0, 0.0, 0.0, {{31.0, 0.0}}}), "prescription.prism", "30");
  LensRequest contact = order({2.0, 0.0, 0.0, 0.0, {}}, LensDesign::contact);
  contact.base_curve = 4.0;
  expect_refused(contact, "base_curve_D", "back_radius_mm");
  contact.base_curve.reset();
  contact.prescription.sphere = 38.0;
  contact.refraction_vertex = 0.03;
  expect_refused(contact, "prescription.sphere", "before the eye");
  LensRequest nothing = order({std::nan(""), 0.0, 0.0, 0.0, {}});
  expect_refused(nothing, "prescription.sphere", "nan");
}

TEST(Refusals, AGivenThicknessThatIsEnoughIsKept) {
  LensRequest request = order({4.0, 0.0, 0.0, 0.0, {}});
  request.centre_thickness = 0.008;
  const DesignedLens d = lenses::design_lens(request);
  EXPECT_EQ(d.lens.centre_thickness, 0.008);
  EXPECT_GT(d.thinnest_edge, 0.001);
}

}  // namespace
