// What a viewer is warned of, against figures made by hand.
#include "lenses/viewer_findings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lenses/lens_model.hpp"
#include "lenses/trace.hpp"

namespace {

using lenses::Finding;
using lenses::HeadsetDisplay;
using lenses::Side;
using lenses::Viewer;
using lenses::Wearer;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLensToPupil = 0.013 + 0.00305;

Viewer viewer(double sphere, double cylinder = 0.0, double axis_deg = 0.0, double amplitude = 0.0) {
  Viewer v;
  v.refraction = {sphere, cylinder, axis_deg * kDegree};
  v.accommodation_amplitude = amplitude;
  return v;
}

std::vector<std::string> codes(const std::vector<Finding>& findings) {
  std::vector<std::string> out;
  for (const Finding& f : findings) out.push_back(f.code);
  return out;
}

TEST(ViewerResidual, IsTheEyesOwnAtTheDisplay) {
  // -3 D at the spectacle plane is 2.862 D too strong at the pupil; the display at 1.3 m takes 0.769 of it.
  const double excess = 3.0 / (1.0 + 3.0 * kLensToPupil);
  const auto myope = lenses::viewer_residual(viewer(-3.0), 60.0, 1.3);
  EXPECT_NEAR(myope.x, excess - 1.0 / 1.3, 1e-12);
  EXPECT_NEAR(myope.z, myope.x, 1e-12);
  EXPECT_NEAR(myope.x, 2.09, 0.005);
  // Accommodation cannot help a myope, and helps a hyperope as far as it goes.
  EXPECT_EQ(lenses::viewer_residual(viewer(-3.0, 0.0, 0.0, 8.0), 20.0, 1.3).x, myope.x);
  const double lack = 2.0 / (1.0 - 2.0 * kLensToPupil) + 1.0 / 1.3;
  EXPECT_NEAR(lenses::viewer_residual(viewer(2.0, 0.0, 0.0, 8.0), 20.0, 1.3).x, 0.0, 1e-12);
  EXPECT_NEAR(lenses::viewer_residual(viewer(2.0, 0.0, 0.0, 1.0), 20.0, 1.3).x, 1.0 - lack, 1e-12);
  // With contact lenses only the display's distance is left; by age, 0.09 D at 62.
  Viewer worn = viewer(-3.0);
  worn.worn_in_headset = Viewer::Worn::contacts;
  worn.accommodation_amplitude.reset();
  EXPECT_NEAR(lenses::viewer_residual(worn, 62.0, 1.5).x, lenses::accommodation_amplitude_at(62.0) - 1.0 / 1.5, 1e-12);
}

TEST(ViewerFindings, ABlurInAnyMeridianIsWarnedOf) {
  Wearer wearer;
  wearer.age = 60.0;
  HeadsetDisplay headset;
  headset.focal_distance = 2.0;
  // -0.5 D and 2 m: in focus; a cylinder of -0.4 leaves 0.2 to either side of it, one of -0.8 leaves 0.4.
  wearer.viewer[0] = viewer(-0.5 / (1.0 - 0.5 * kLensToPupil));
  EXPECT_TRUE(lenses::viewer_findings(wearer, headset).empty());
  wearer.viewer[0] = viewer(-0.3, -0.4, 30.0);
  EXPECT_TRUE(lenses::viewer_findings(wearer, headset).empty());
  wearer.viewer[1] = viewer(-0.1, -0.8, 30.0);
  const auto findings = lenses::viewer_findings(wearer, headset);
  ASSERT_EQ(codes(findings), std::vector<std::string>{"own_blur"});
  EXPECT_EQ(findings[0].side, Side::left);
  EXPECT_NEAR(std::abs(findings[0].value), 0.4, 0.02);
  EXPECT_EQ(findings[0].unit, "D");
  EXPECT_NE(findings[0].message.find("left eye"), std::string::npos);
  EXPECT_NE(findings[0].message.find("2.00 m"), std::string::npos);
}

TEST(ViewerFindings, TheLimitIsAQuarter) {
  Wearer wearer;
  wearer.age = 60.0;
  HeadsetDisplay headset;
  headset.focal_distance = 1e6;
  const auto at_pupil = [](double excess) { return viewer(-excess / (1.0 - excess * kLensToPupil)); };
  wearer.viewer[0] = at_pupil(0.249);
  EXPECT_TRUE(lenses::viewer_findings(wearer, headset).empty());
  wearer.viewer[0] = at_pupil(0.251);
  EXPECT_EQ(codes(lenses::viewer_findings(wearer, headset)), std::vector<std::string>{"own_blur"});
}

TEST(ViewerFindings, TheYoungAreToldOfConvergence) {
  Wearer wearer;
  wearer.age = 70.0;
  EXPECT_TRUE(lenses::viewer_findings(wearer, {}).empty()) << "no viewer is named";
  wearer.viewer_age = 44.0;
  EXPECT_EQ(codes(lenses::viewer_findings(wearer, {})), std::vector<std::string>{"convergence"});
  wearer.viewer_age = 45.0;
  EXPECT_TRUE(lenses::viewer_findings(wearer, {}).empty());
  // Without an age of their own the wearer's counts.
  wearer.viewer_age.reset();
  wearer.age = 30.0;
  wearer.viewer[0] = viewer(0.0, 0.0, 0.0, 5.0);
  EXPECT_EQ(codes(lenses::viewer_findings(wearer, {})), std::vector<std::string>{"convergence"});
}

TEST(DistanceFinding, HasThePrismByPrentice) {
  Wearer wearer;  // 63 mm
  EXPECT_FALSE(lenses::distance_finding(wearer, 0.0639, {-4.0, -4.0}));
  EXPECT_FALSE(lenses::distance_finding(wearer, 0.0621, {-4.0, -4.0}));
  const auto finding = lenses::distance_finding(wearer, 0.068, {-4.0, -4.0});
  ASSERT_TRUE(finding);
  EXPECT_NEAR(finding->value, 5.0, 1e-9);
  EXPECT_EQ(finding->unit, "mm");
  // 2.5 mm an eye, 0.25 cm times 4 D: 1 prism dioptre each. Wider pupils look through the outer part of a minus lens,
  // thicker outside.
  EXPECT_NE(finding->message.find("2.00 prism dioptres base out"), std::string::npos) << finding->message;
  const auto narrow = lenses::distance_finding(wearer, 0.060, {2.0, 3.0});
  EXPECT_NE(narrow->message.find("0.75 prism dioptres base out"), std::string::npos) << narrow->message;
  EXPECT_NE(lenses::distance_finding(wearer, 0.068, {0.0, 0.0})->message.find("0.00"), std::string::npos);
}

TEST(VerticalPrism, ReadsALensByItsLineOfSight) {
  // A wedge of glass, base up, as the tracer has it: 100 (n - 1) times its angle.
  lenses::Lens wedge;
  wedge.index = 1.5;
  wedge.back_placement.slope = {0.0, 0.04};  // thicker above
  lenses::LensModel model;
  static_cast<void>(lenses::append_lens(model, &wedge, Side::right, 0.00305));
  const auto eye = lenses::make_eye_data({}, 0.0, 0.0035);
  const glm::dvec3 ahead(0.0, 0.0, -1.0);
  const auto line = lenses::f64::trace_sight_line(lenses::f64::Table{model.table}, model.lens[0], eye, glm::dmat3(1.0),
                                                  ahead, glm::dvec2(0.0), glm::dvec2(0.0));
  const double prism = lenses::vertical_prism({ahead, line.direction_object});
  EXPECT_NEAR(prism, 2.0, 0.01);  // the tangent's third order
  EXPECT_FALSE(lenses::vertical_prism_finding({{{ahead, line.direction_object}, {ahead, line.direction_object}}}));
  const auto finding = lenses::vertical_prism_finding({{{ahead, line.direction_object}, {ahead, ahead}}});
  ASSERT_TRUE(finding);
  EXPECT_NEAR(finding->value, prism, 1e-12);
  EXPECT_EQ(finding->unit, "pd");
}

TEST(VerticalPrism, TheLimitIsOneDioptreAndTheSideDoesNotMatter) {
  const auto up = [](double degrees) {
    return glm::dvec3(0.3, std::tan(degrees * kDegree) * std::hypot(0.3, 1.0), -1.0);
  };
  const double one = std::atan(0.01) / kDegree;
  EXPECT_FALSE(lenses::vertical_prism_finding({{{up(0.0), up(0.99 * one)}, {up(5.0), up(5.0)}}}));
  EXPECT_TRUE(lenses::vertical_prism_finding({{{up(0.0), up(1.01 * one)}, {up(5.0), up(5.0)}}}));
  EXPECT_LT(lenses::vertical_prism_finding({{{up(0.0), up(0.0)}, {up(5.0), up(5.0 + 1.01 * one)}}})->value, 0.0);
}

}  // namespace
