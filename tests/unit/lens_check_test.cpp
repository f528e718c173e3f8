// Every fault of a lens by name, and no fault where there is none.
#include "lenses/lens_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>

#include "lenses/bspline_field.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "lenses/polygon.hpp"
#include "tests/support/surface_probe.hpp"

namespace {

using lenses::check_lens;
using lenses::Lens;
using lenses::LensCheck;
using lenses::LensFault;
using lenses::LensFinding;
using lenses::Side;
using lenses::Sphere;

constexpr double kDegree = std::numbers::pi / 180.0;

// Parallel surfaces of 5 D.
Lens good_lens() {
  Lens lens;
  lens.index = 1.6;
  lens.centre_thickness = 0.002;
  lens.diameter = 0.060;
  lens.front = Sphere{1.0 / 0.122};
  lens.back = Sphere{1.0 / 0.120};
  return lens;
}

std::vector<glm::dvec2> ellipse(double half_width, double half_height, glm::dvec2 centre = glm::dvec2(0.0)) {
  std::vector<glm::dvec2> outline;
  for (int i = 0; i < 72; ++i) {
    const double a = 5.0 * kDegree * i;
    outline.push_back(centre + glm::dvec2(half_width * std::cos(a), half_height * std::sin(a)));
  }
  return outline;
}

std::vector<LensFault> faults_of(const LensCheck& check) {
  std::vector<LensFault> faults;
  for (const LensFinding& finding : check.findings) faults.push_back(finding.fault);
  return faults;
}

// The one finding, of this fault.
LensFinding only(const LensCheck& check, LensFault fault, const std::string& field) {
  EXPECT_EQ(faults_of(check), std::vector<LensFault>{fault});
  if (check.findings.empty()) return {fault, {}, {}, 0.0, 0.0, {}};
  EXPECT_EQ(check.findings.front().field, field);
  EXPECT_FALSE(check.findings.front().message.empty());
  return check.findings.front();
}

TEST(LensCheck, FindsNothingWrongWithAGoodLens) {
  const LensCheck check = check_lens(good_lens(), Side::right);
  EXPECT_TRUE(check.findings.empty());
  EXPECT_EQ(check.centre_thickness, 0.002);
  // Sags at 30 mm: R - sqrt(R^2 - 30^2).
  const double front = 0.122 - std::sqrt(0.122 * 0.122 - 9e-4), back = 0.120 - std::sqrt(0.120 * 0.120 - 9e-4);
  EXPECT_NEAR(*check.thinnest_edge, 0.002 + back - front, 1e-12);
  EXPECT_NEAR(*check.thickest_edge, *check.thinnest_edge, 1e-12);
  // Nearest to the globe on the axis: the vertex distance.
  EXPECT_NEAR(*check.eye_clearance, 0.013, 1e-12);
}

TEST(LensCheck, FindsNothingWrongWithTheExamples) {
  for (const auto& entry : std::filesystem::directory_iterator(VERGENCE_ASSETS "/spectacles")) {
    SCOPED_TRACE(entry.path());
    const lenses::Spectacles pair = lenses::read_spectacles(entry.path().string());
    for (const Side side : {Side::right, Side::left}) {
      for (const LensFinding& finding : check_lens(pair.lens[static_cast<std::size_t>(side)], side).findings) {
        ADD_FAILURE() << finding.field << ": " << finding.message;
      }
    }
  }
}

TEST(LensCheck, FindsSurfacesThatCross) {
  Lens lens = good_lens();
  lens.front = Sphere{1.0 / 0.080};  // a plus lens too thin for its diameter
  const auto finding = only(check_lens(lens, Side::right), LensFault::surfaces_cross, "diameter_mm");
  const double front = 0.080 - std::sqrt(0.080 * 0.080 - 9e-4), back = 0.120 - std::sqrt(0.120 * 0.120 - 9e-4);
  EXPECT_NEAR(finding.value, 1e3 * (0.002 + back - front), 1e-9);
  EXPECT_NEAR(glm::length(*finding.at), 0.030, 1e-9);
  // Only outside the outline: nothing wrong.
  lens.outline = ellipse(0.018, 0.014);
  EXPECT_TRUE(check_lens(lens, Side::right).findings.empty());
}

TEST(LensCheck, FindsThinGlass) {
  Lens lens = good_lens();
  lens.front = Sphere{1.0 / 0.100};
  const double edge = *check_lens(lens, Side::right).thinnest_edge;
  ASSERT_LT(edge, 0.0013);
  ASSERT_GT(edge, 0.0);
  EXPECT_TRUE(check_lens(lens, Side::right, {.least_edge = edge - 1e-6}).findings.empty());
  const auto finding =
      only(check_lens(lens, Side::right, {.least_edge = edge + 1e-6}), LensFault::edge_too_thin, "diameter_mm");
  EXPECT_NEAR(finding.value, 1e3 * edge, 1e-9);
  Lens minus = good_lens();
  minus.back = Sphere{1.0 / 0.080};
  minus.centre_thickness = 0.0007;
  only(check_lens(minus, Side::right), LensFault::glass_too_thin, "centre_thickness_mm");
  EXPECT_TRUE(check_lens(minus, Side::right, {.least_centre = 0.0007}).findings.empty());
}

TEST(LensCheck, FindsSurfacesThatEnd) {
  Lens lens = good_lens();
  lens.front = Sphere{1.0 / 0.029};
  lens.centre_thickness = 0.05;
  only(check_lens(lens, Side::right), LensFault::surface_ends, "front");
  Lens patch = good_lens();
  patch.back = lenses::fit_height_field([](double x, double y) { return 4.0 * (x * x + y * y); }, 20, 0.025);
  only(check_lens(patch, Side::right), LensFault::surface_ends, "back");
}

TEST(LensCheck, FindsOutlinesThatDoNotFit) {
  Lens lens = good_lens();
  lens.outline = ellipse(0.031, 0.020);
  const auto finding = only(check_lens(lens, Side::right), LensFault::outline_too_large, "outline");
  EXPECT_NEAR(finding.value, 31.0, 1e-9);
  EXPECT_NEAR(finding.limit, 30.0, 1e-9);
  lens.outline = ellipse(0.026, 0.018);
  std::swap(lens.outline[10], lens.outline[40]);
  const auto faults = faults_of(check_lens(lens, Side::right));
  EXPECT_NE(std::ranges::find(faults, LensFault::outline_crosses_itself), faults.end());
}

TEST(LensCheck, FindsALensThatTouchesTheWearer) {
  Lens close = good_lens();
  close.fit.vertex_distance = 0.0;
  const auto on_eye = faults_of(check_lens(close, Side::right));
  EXPECT_NE(std::ranges::find(on_eye, LensFault::touches_eye), on_eye.end());
  Lens tilted = good_lens();
  tilted.fit.pantoscopic_tilt = 30.0 * kDegree;  // the lower edge comes to the cheek
  auto finding = only(check_lens(tilted, Side::right), LensFault::touches_face, "fit");
  EXPECT_LT(finding.at->y, 0.0);
  EXPECT_NE(finding.message.find("cheek"), std::string::npos);
  tilted.fit.pantoscopic_tilt = -30.0 * kDegree;
  finding = only(check_lens(tilted, Side::left), LensFault::touches_face, "fit");
  EXPECT_NE(finding.message.find("brow"), std::string::npos);
  // Beside the head there is room: a wrapped lens is fine.
  Lens wrapped = good_lens();
  wrapped.outline = ellipse(0.028, 0.015);
  wrapped.fit.wrap = 25.0 * kDegree;
  EXPECT_TRUE(check_lens(wrapped, Side::right).findings.empty());
  // A contact lens is to touch the eye.
  Lens contact = good_lens();
  contact.attached_to = Lens::AttachedTo::eye;
  contact.fit.vertex_distance = 0.0;
  contact.diameter = 0.011;
  contact.centre_thickness = 0.00008;
  contact.front = contact.back = Sphere{1.0 / 0.0086};
  EXPECT_TRUE(check_lens(contact, Side::right).findings.empty());
}

TEST(LensCheck, FindsPointsOutsideTheOutline) {
  Lens lens = good_lens();
  lens.outline = ellipse(0.025, 0.016);
  lens.reference_points.near = {-0.002, -0.017};
  only(check_lens(lens, Side::right), LensFault::point_outside, "reference_points_mm.near");
  lens.reference_points.near = {-0.002, -0.015};
  EXPECT_TRUE(check_lens(lens, Side::right).findings.empty());
  lens.fit.decentration = {0.0, -0.018};  // the pupil is 18 mm above the origin
  only(check_lens(lens, Side::right), LensFault::point_outside, "fit.decentration_mm");
}

double wave(double x, double y) {
  return 4.0 * (x * x + y * y) + 2e-5 * std::sin(300.0 * x) * std::cos(200.0 * y);
}

lenses::BsplineHeightField net_of(std::size_t count) {
  return lenses::fit_height_field(wave, count, 0.035);
}

// The estimate against the error that it estimates: a wave of known derivatives through nets of several sizes.
TEST(LensCheck, EstimatesTheErrorOfACoarseNet) {
  for (const std::size_t count : {18U, 25U, 40U, 60U}) {
    SCOPED_TRACE(count);
    const auto surface = net_of(count);
    const support::SurfaceProbe probe(surface);
    double error = 0.0;
    for (double x = -0.028; x <= 0.028; x += 0.37e-3) {
      for (double y = -0.028; y <= 0.028; y += 0.37e-3) {
        const glm::dvec3 d = probe.at(x, y).hessian - support::hessian_of(wave, x, y);
        error = std::max({error, 0.6 * std::abs(d.x), 0.6 * std::abs(d.z)});
      }
    }
    const double estimate = lenses::net_error(surface, 1.6, 0.028);
    EXPECT_GT(estimate, 0.3 * error);
    EXPECT_LT(estimate, 3.0 * error);
  }
  Lens lens = good_lens();
  lens.front = net_of(18);
  lens.centre_thickness = 0.004;
  only(check_lens(lens, Side::right), LensFault::net_too_coarse, "front");
  EXPECT_TRUE(check_lens(lens, Side::right, {.coarse_net = 10.0}).findings.empty());
  lens.front = net_of(60);
  EXPECT_TRUE(check_lens(lens, Side::right).findings.empty());
}

TEST(Polygon, KnowsInsideAndCrossings) {
  const std::vector<glm::dvec2> notch{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  EXPECT_TRUE(lenses::is_inside(notch, {1.0, 1.0}));
  EXPECT_FALSE(lenses::is_inside(notch, {2.0, 3.0}));
  EXPECT_FALSE(lenses::is_inside(notch, {5.0, 1.0}));
  EXPECT_FALSE(lenses::self_crossing(notch));
  const std::vector<glm::dvec2> bow{{0, 0}, {4, 4}, {4, 0}, {0, 4}};
  const auto at = lenses::self_crossing(bow);
  ASSERT_TRUE(at);
  EXPECT_LT(glm::distance(*at, glm::dvec2(2.0, 2.0)), 1e-12);
}

}  // namespace
