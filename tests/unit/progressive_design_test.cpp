// Progressive surfaces as designed: the closed form's figures, what the report says about known surfaces, and what the
// variational design reaches. The closed form's figures were computed independently of this code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "lenses/bspline_field.hpp"
#include "lenses/design/height_field_solver.hpp"
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

TEST(ProgressiveClosedForm, EyeSideHasTheSamePowersWithFallingCurvature) {
  ProgressiveConfig config = family_layout();
  config.face = Face::eye_side;
  config.distance_power = -1.0;  // curvature passes through 0 on the way to +1 D
  const lenses::ProgressiveDesign design = lenses::design_progressive(config);
  EXPECT_NEAR(design.report.distance_power, -1.0, 0.01);
  EXPECT_NEAR(design.report.near_power, 1.0, 0.01);
  const lenses::HeightFieldReader surface(design.surface);
  EXPECT_GT(surface.at({0.0, 0.008}).hessian.x, 0.0);
  EXPECT_LT(surface.at(config.near_point()).hessian.x, 0.0);
}

// A sphere of 6 D has no addition, no cylinder, no rate: the report must say so.
TEST(ProgressiveReport, OfASphere) {
  ProgressiveConfig config;
  const double curvature = 6.0 / 0.6;
  const BsplineHeightField sphere = lenses::fit_height_field(
      [&](double x, double y) {
        const double r2 = x * x + y * y;
        return curvature * r2 / (1.0 + std::sqrt(1.0 - curvature * curvature * r2));
      },
      50, config.half_width());
  const ProgressiveReport report = lenses::report_progressive(sphere, config);
  // The fit's own deviation: h^2/12 of the fourth derivative, at the rim (h = 1.5 mm).
  constexpr double kFit = 2e-3;
  EXPECT_NEAR(report.distance_power, 6.0, kFit);
  EXPECT_NEAR(report.addition(), 0.0, kFit);
  EXPECT_LT(report.peak_cylinder, kFit);
  EXPECT_EQ(report.corridor_to_85_percent, 0.0);
  EXPECT_LT(report.minkwitz_bound, 2.0);
  // Nothing limits the zones but the rim.
  const double y = config.near_point().y;
  EXPECT_NEAR(report.widths[0].at_near, 2.0 * std::sqrt(0.0325 * 0.0325 - y * y), 2e-4);
}

// z = x y / r: cylinder 2 (n - 1) / r at the origin, no mean power; principal meridians at 45 degrees.
TEST(SurfaceCurvature, OfASaddle) {
  const lenses::SurfaceCurvature c = lenses::surface_curvature({0.0, {0.0, 0.0}, {0.0, 5.0, 0.0}});
  EXPECT_EQ(c.mean, 0.0);
  EXPECT_EQ(c.plus, 0.0);
  EXPECT_EQ(c.difference(), 10.0);
}

// On a sphere every point is an umbilic of the same curvature, however steep it lies.
TEST(SurfaceCurvature, OfASphereAnywhere) {
  const double r = 0.05;
  for (const glm::dvec2 p : {glm::dvec2(0.0, 0.0), glm::dvec2(0.02, -0.03), glm::dvec2(-0.044, 0.01)}) {
    const double h = std::sqrt(r * r - glm::dot(p, p));
    const glm::dvec3 hessian(1.0 / h + p.x * p.x / (h * h * h), p.x * p.y / (h * h * h),
                             1.0 / h + p.y * p.y / (h * h * h));
    const lenses::SurfaceCurvature c = lenses::surface_curvature({r - h, p / h, hessian});
    EXPECT_NEAR(c.mean, 1.0 / r, 1e-12);
    EXPECT_NEAR(c.difference(), 0.0, 1e-12);
  }
}

// Against central differences; both have rounding and truncation below 1e-8 of derivatives of the order of 100.
TEST(SurfaceCurvature, GradientIsTheDerivative) {
  constexpr double kStep = 1e-5, kTolerance = 1e-6;
  std::mt19937_64 random(1998);
  std::uniform_real_distribution<double> slope(-0.8, 0.8), bend(-25.0, 25.0);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(testing::Message() << "seed 1998, point " << i);
    const std::array<double, 5> at{slope(random), slope(random), bend(random), bend(random), bend(random)};
    const auto curvature = [](const std::array<double, 5>& d) {
      return lenses::surface_curvature({0.0, {d[0], d[1]}, {d[2], d[3], d[4]}});
    };
    const lenses::CurvatureGradient gradient = lenses::curvature_gradient({0.0, {at[0], at[1]}, {at[2], at[3], at[4]}});
    for (std::size_t k = 0; k < 5; ++k) {
      std::array<double, 5> low = at, high = at;
      low[k] -= kStep;
      high[k] += kStep;
      const lenses::SurfaceCurvature a = curvature(low), b = curvature(high);
      EXPECT_NEAR(gradient.mean[k], (b.mean - a.mean) / (2.0 * kStep), kTolerance);
      EXPECT_NEAR(gradient.plus[k], (b.plus - a.plus) / (2.0 * kStep), kTolerance);
      EXPECT_NEAR(gradient.cross[k], (b.cross - a.cross) / (2.0 * kStep), kTolerance);
    }
  }
}

TEST(HeightFieldReader, DerivativesAreThoseOfTheHeight) {
  const lenses::ProgressiveDesign design = lenses::design_progressive(family_layout());
  const lenses::HeightFieldReader surface(design.surface);
  // Inside one cell a cubic's central differences are exact up to the third derivative's h^2 and rounding.
  constexpr double kStep = 1e-5;
  for (const glm::dvec2 p : {glm::dvec2(0.0012, -0.0031), glm::dvec2(-0.0204, 0.0132), glm::dvec2(0.0283, -0.0112)}) {
    const lenses::HeightPoint at = surface.at(p);
    const auto dx = glm::dvec2(kStep, 0.0), dy = glm::dvec2(0.0, kStep);
    const lenses::HeightPoint east = surface.at(p + dx), west = surface.at(p - dx), north = surface.at(p + dy),
                              south = surface.at(p - dy);
    EXPECT_NEAR(at.gradient.x, (east.z - west.z) / (2.0 * kStep), 1e-7);
    EXPECT_NEAR(at.gradient.y, (north.z - south.z) / (2.0 * kStep), 1e-7);
    EXPECT_NEAR(at.hessian.x, (east.gradient.x - west.gradient.x) / (2.0 * kStep), 1e-6);
    EXPECT_NEAR(at.hessian.y, (north.gradient.x - south.gradient.x) / (2.0 * kStep), 1e-6);
    EXPECT_NEAR(at.hessian.z, (north.gradient.y - south.gradient.y) / (2.0 * kStep), 1e-6);
  }
}

// Where the wanted curvature is that of a sphere, the sphere is found, from a start that is far from it.
TEST(HeightFieldSolver, FindsASphere) {
  const BsplineHeightField start =
      lenses::fit_height_field([](double x, double y) { return 3.0 * x * x + 5.0 * y * y + x * y; }, 24, 0.03);
  lenses::HeightFieldSolver solver(start, 0.6);
  for (lenses::DesignSite& site : solver.sites()) {
    site.power = 6.0;
    site.power_weight = site.cylinder_weight = 1.0;
  }
  double last = solver.cost();
  for (int i = 0; i < 5; ++i) {
    solver.step();
    EXPECT_LE(solver.cost(), last);
    last = solver.cost();
  }
  EXPECT_LT(solver.step(), 1e-6) << "wrong derivatives would still be creeping";
  const lenses::HeightFieldReader surface(solver.surface());
  const auto sphere = [](double x, double y) { return 0.1 - std::sqrt(0.01 - x * x - y * y); };
  // The net's own error: 2.9 mm cells on a radius of 100 mm leave some 10 nm.
  for (double x = -0.028; x <= 0.028; x += 0.004) {
    for (double y = -0.028; y <= 0.028; y += 0.004) EXPECT_NEAR(surface.at({x, y}).z, sphere(x, y), 1e-7);
  }
}

class Variational : public testing::Test {
 protected:
  static lenses::ProgressiveDesign design(double hardness, double addition = 2.0) {
    ProgressiveConfig config;
    config.hardness = hardness;
    config.addition = addition;
    return lenses::design_progressive(config);
  }
  static lenses::ProgressiveDesign closed_form(double addition = 2.0) {
    ProgressiveConfig config;
    config.method = Method::closed_form;
    config.addition = addition;
    return lenses::design_progressive(config);
  }
};

TEST_F(Variational, SoftHasLittleCylinderAndHardWideZones) {
  // The limit of width nearest to a quarter of the addition: about the corridor, not the lens.
  for (const auto& [addition, limit] : {std::pair{1.0, 0U}, std::pair{2.0, 1U}, std::pair{3.0, 1U}}) {
    SCOPED_TRACE(addition);
    const ProgressiveReport soft = design(0.0, addition).report, hard = design(1.0, addition).report,
                            closed = closed_form(addition).report;
    EXPECT_LT(soft.peak_cylinder, 0.7 * closed.peak_cylinder);
    EXPECT_LT(soft.peak_cylinder, 0.85 * addition);
    EXPECT_GT(hard.widths[limit].narrowest, 1.2 * closed.widths[limit].narrowest);
    EXPECT_GT(hard.widths[limit].at_distance, closed.widths[limit].at_distance);
  }
}

TEST_F(Variational, HardnessRaisesPeakAndWidths) {
  double peak = 0.0, corridor = 0.0, near = 0.0, distance = 0.0;
  for (const double hardness : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    SCOPED_TRACE(hardness);
    const ProgressiveReport report = design(hardness).report;
    // Cylinder below a quarter of the addition.
    EXPECT_GT(report.peak_cylinder, peak);
    EXPECT_GT(report.widths[1].narrowest, corridor);
    EXPECT_GT(report.widths[1].at_near, near);
    EXPECT_GT(report.widths[1].at_distance, distance);
    peak = report.peak_cylinder;
    corridor = report.widths[1].narrowest;
    near = report.widths[1].at_near;
    distance = report.widths[1].at_distance;
  }
}

// No surface beats Minkwitz beside an umbilic line; differences over 1.5 mm see it to a few per cent.
TEST_F(Variational, KeepsToMinkwitz) {
  for (const double hardness : {0.0, 0.5, 1.0}) {
    const ProgressiveReport report = design(hardness).report;
    EXPECT_LT(report.minkwitz_reached, 1.02 * report.minkwitz_bound);
    // The line of a soft design gives way a little: it is not quite umbilic.
    EXPECT_GT(report.minkwitz_reached, 0.93 * report.minkwitz_bound);
    // The least that a rise of 2 D over the corridor and 1.5 mm above it can have is an even one.
    EXPECT_GT(report.minkwitz_bound, 2.0 * 2.0 / 0.0155);
  }
}

TEST_F(Variational, CentreIsHeldAndTheLeftLensIsTheMirrorImage) {
  ProgressiveConfig config;
  const lenses::ProgressiveDesign right = lenses::design_progressive(config);
  config.side = lenses::Side::left;
  const lenses::ProgressiveDesign left = lenses::design_progressive(config);
  const lenses::HeightFieldReader a(right.surface), b(left.surface);
  // A picometre and a nanoradian: the rounding of a solve with a condition of 1e6 or so.
  EXPECT_NEAR(a.at({0.0, 0.0}).z, 0.0, 1e-12);
  EXPECT_NEAR(glm::length(a.at({0.0, 0.0}).gradient), 0.0, 1e-9);
  for (const glm::dvec2 p : {glm::dvec2(0.01, -0.01), glm::dvec2(-0.007, 0.02)}) {
    EXPECT_NEAR(a.at(p).z, b.at({-p.x, p.y}).z, 1e-16);
  }
  EXPECT_LT(right.report.peak_at.x * left.report.peak_at.x, 0.0);
  // Nose of the right lens toward -x.
  EXPECT_GT(lenses::surface_curvature(a.at({-0.005, -0.011})).mean,
            lenses::surface_curvature(a.at({0.005, -0.011})).mean + 0.3);
}

TEST_F(Variational, ProgressRunsToTheEnd) {
  std::vector<double> seen;
  ProgressiveConfig config;
  config.grid = 24;
  static_cast<void>(lenses::design_progressive(config, [&](double done) { seen.push_back(done); }));
  ASSERT_GT(seen.size(), 3U);
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_GT(seen.front(), 0.0);
  EXPECT_EQ(seen.back(), 1.0);
}

TEST(ProgressiveConfig, NamesWhatIsOutOfRange) {
  const auto field_of = [](auto change) {
    ProgressiveConfig config;
    change(config);
    try {
      config.validate();
    } catch (const tracking::InputError& error) {
      return error.field();
    }
    return std::string("none");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field_of([](auto&) {}), "none");
  EXPECT_EQ(field_of([](auto& c) { c.addition = 0.4; }), "addition");
  EXPECT_EQ(field_of([&](auto& c) { c.addition = nan; }), "addition");
  EXPECT_EQ(field_of([](auto& c) { c.corridor_length = 0.019; }), "corridor_length");
  EXPECT_EQ(field_of([](auto& c) { c.corridor_length = 18 * 1e-3; }), "none");
  EXPECT_EQ(field_of([](auto& c) { c.inset = -1e-3; }), "inset");
  EXPECT_EQ(field_of([](auto& c) { c.hardness = 1.1; }), "hardness");
  EXPECT_EQ(field_of([](auto& c) { c.index = 1.0; }), "index");
  EXPECT_EQ(field_of([](auto& c) { c.grid = 101; }), "grid");
  EXPECT_EQ(field_of([](auto& c) { c.grid = 0; }), "grid");
  EXPECT_EQ(field_of([](auto& c) { c.diameter = 1.0; }), "diameter");
  EXPECT_EQ(field_of([&](auto& c) { c.distance_power = nan; }), "distance_power");
  // A lens that ends where its surface turns upright.
  EXPECT_EQ(field_of([](auto& c) { c.distance_power = 14.0; }), "diameter");
}

}  // namespace
