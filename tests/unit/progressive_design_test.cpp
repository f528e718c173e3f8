// Progressive surfaces as designed: the closed form's figures, what the report says about known surfaces, and what the
// variational design reaches. The closed form's figures were computed independently of this code.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lenses/bspline_field.hpp"
#include "lenses/design/progressive_report.hpp"
#include "lenses/design/surface_power.hpp"
#include "tracking/input_error.hpp"

namespace {

using lenses::BsplineHeightField;
using lenses::ProgressiveConfig;
using lenses::ProgressiveReport;
using Method = ProgressiveConfig::Method;
using Face = ProgressiveConfig::Face;

// The family's own layout: rise over 18 mm along a meridian turned by 8 degrees.
ProgressiveConfig family_layout() {
  ProgressiveConfig config;
  const double turn = 8.0 * std::numbers::pi / 180.0;
  config.method = Method::closed_form;
  config.corridor_length = 0.017 * std::cos(turn);
  config.inset = 0.017 * std::sin(turn);
  config.diameter = 0.064;  // a net of 70 mm
  return config;
}

TEST(ProgressiveClosedForm, LayoutIsTheFamilysOwn) {
  const lenses::ProgressiveFamilyConfig family = lenses::family_config(family_layout()), expected;
  EXPECT_NEAR(family.rise_start, expected.rise_start, 1e-15);
  EXPECT_NEAR(family.rise_length, expected.rise_length, 1e-15);
  EXPECT_NEAR(family.distance_pole, expected.distance_pole, 1e-15);
  EXPECT_NEAR(family.near_pole, expected.near_pole, 1e-15);
  EXPECT_NEAR(family.inset, expected.inset, 1e-15);
}

TEST(ProgressiveClosedForm, ReportHasTheKnownFigures) {
  const ProgressiveConfig config = family_layout();
  const lenses::ProgressiveDesign design = lenses::design_progressive(config);
  const ProgressiveReport& report = design.report;
  // The fit of 50 x 50 is within 0.04 D of power and 0.065 D of cylinder; on the line and at the peak it is closer.
  EXPECT_NEAR(report.distance_power, 5.00, 0.01);
  EXPECT_NEAR(report.near_power, 7.00, 0.01);
  EXPECT_NEAR(report.corridor_to_85_percent, 0.0118, 1.5e-4);
  EXPECT_NEAR(report.peak_cylinder, 2.21, 0.03);
  const lenses::HeightFieldReader surface(design.surface);
  EXPECT_NEAR(0.6 * lenses::surface_curvature(surface.at({-0.002, -0.012})).mean, 6.995, 0.01);
  EXPECT_EQ(report.widths[1].limit, 0.5);
  EXPECT_NEAR(report.widths[1].narrowest, 0.0025, 1.5e-4);
  EXPECT_NEAR(report.widths[1].narrowest_y, -0.004, 0.0015);
  // An exactly umbilic line reaches the bound: 2 * 15/8 * 2 D / 18 mm.
  EXPECT_NEAR(report.minkwitz_bound, 2.0 * 1.875 * 2.0 / 0.018, 0.02 * 417.0);
  EXPECT_NEAR(report.minkwitz_reached / report.minkwitz_bound, 1.0, 0.03);
}

}  // namespace
