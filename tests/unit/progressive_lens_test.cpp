// Progressive lenses as finished from an order: what they weigh up, what they record, what they refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lenses/bspline_field.hpp"
#include "lenses/design/progressive_lens.hpp"
#include "lenses/design/surface_power.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "tracking/input_error.hpp"

namespace {

using lenses::Lens;
using lenses::ProgressiveConfig;
using lenses::ProgressiveLensRequest;
using Face = ProgressiveConfig::Face;

ProgressiveLensRequest order(double sphere, double addition, Face face) {
  ProgressiveLensRequest request;
  request.sphere = sphere;
  request.addition = addition;
  request.surface.face = face;
  request.surface.grid = 30;  // enough to be met, and quick
  return request;
}

// Mean curvature of a surface on the lens axis, by what the lens file says.
double curvature_at(const lenses::Surface& surface, const glm::dvec2& p) {
  if (const auto* net = std::get_if<lenses::BsplineHeightField>(&surface)) {
    return lenses::surface_curvature(lenses::HeightFieldReader(*net).at(p)).mean;
  }
  return std::get<lenses::Sphere>(surface).curvature;
}

TEST(ProgressiveLens, MeetsTheOrderOnEitherFace) {
  for (const Face face : {Face::front, Face::eye_side}) {
    for (const double sphere : {-6.0, -1.25, 0.0, 3.0, 5.0}) {
      SCOPED_TRACE(testing::Message() << (face == Face::front ? "front " : "eye side ") << sphere);
      const ProgressiveLensRequest request = order(sphere, 2.25, face);
      const lenses::ProgressiveLens made = lenses::make_progressive_lens(request);
      const Lens& lens = made.lens;
      EXPECT_NEAR(made.distance_reading, sphere, 1e-8);
      EXPECT_NEAR(made.addition_reading, 2.25, 1e-3);
      // The thick lens's back vertex power from the curvatures at the distance point, 8 mm up: there the glass is some
      // 2 mm thinner or thicker and the surfaces are oblique, which at 5 D makes 0.1 D.
      const glm::dvec2 at = *lens.reference_points.distance;
      const double front = 0.6 * curvature_at(lens.front, at), back = -0.6 * curvature_at(lens.back, at);
      EXPECT_NEAR(front / (1.0 - lens.centre_thickness * front / 1.6) + back, sphere, 0.05 + 0.02 * std::abs(sphere));
      // The progressive face is the one asked for, and the other a sphere.
      EXPECT_TRUE(std::holds_alternative<lenses::BsplineHeightField>(face == Face::front ? lens.front : lens.back));
      EXPECT_TRUE(std::holds_alternative<lenses::Sphere>(face == Face::front ? lens.back : lens.front));
      EXPECT_GE(made.thinnest_edge, request.minimum_edge_thickness);
      EXPECT_GE(lens.centre_thickness, request.minimum_centre_thickness);
      // No more glass than needed.
      EXPECT_TRUE(made.thinnest_edge < request.minimum_edge_thickness + 5e-5 ||
                  lens.centre_thickness == request.minimum_centre_thickness);
    }
  }
}

TEST(ProgressiveLens, RecordsWhatItWasMadeFor) {
  ProgressiveLensRequest request = order(-2.0, 1.75, Face::front);
  request.surface.side = lenses::Side::left;
  const Lens lens = lenses::make_progressive_lens(request).lens;
  ASSERT_TRUE(lens.order);
  EXPECT_EQ(lens.order->ordered.sphere, -2.0);
  EXPECT_EQ(lens.order->ordered.addition, 1.75);
  EXPECT_EQ(*lens.reference_points.near, glm::dvec2(0.0025, 0.004 - 0.014));
  EXPECT_EQ(lens.fit.decentration, glm::dvec2(0.0, -0.004));  // fitting cross before the pupil
  const Lens again = lenses::parse_lens(lenses::to_json(lens), "made.json");
  EXPECT_EQ(again.order, lens.order);
  EXPECT_EQ(again.reference_points, lens.reference_points);
  EXPECT_EQ(std::get<lenses::BsplineHeightField>(again.front).control_z.size(), 30U * 30U);
}

TEST(ProgressiveLens, StrongPlusIsMadeSmaller) {
  const lenses::ProgressiveLens made = lenses::make_progressive_lens(order(6.0, 3.0, Face::front));
  EXPECT_LT(made.lens.diameter, 0.065);
  EXPECT_GE(made.lens.diameter, 0.04);
  EXPECT_NEAR(made.addition_reading, 3.0, 1e-3);
}

TEST(ProgressiveLens, NamesWhatCannotBeMade) {
  const auto field_of = [](auto change) {
    ProgressiveLensRequest request = order(0.0, 2.0, Face::front);
    change(request);
    try {
      static_cast<void>(lenses::make_progressive_lens(request));
    } catch (const tracking::InputError& error) {
      return error.field();
    }
    return std::string("none");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field_of([](auto&) {}), "none");
  EXPECT_EQ(field_of([](auto& r) { r.addition = 0.5; }), "addition");
  EXPECT_EQ(field_of([](auto& r) { r.addition = 3.6; }), "addition");
  EXPECT_EQ(field_of([&](auto& r) { r.sphere = nan; }), "sphere");
  EXPECT_EQ(field_of([](auto& r) { r.base_curve = -3.0; }), "base_curve");
  EXPECT_EQ(field_of([](auto& r) { r.base_curve = 24.0; }), "base_curve");
  EXPECT_EQ(field_of([](auto& r) { r.abbe = 1.0; }), "abbe");
  EXPECT_EQ(field_of([](auto& r) { r.surface.hardness = 2.0; }), "hardness");
  EXPECT_EQ(field_of([](auto& r) { r.diameter = 0.1; }), "diameter");
  EXPECT_EQ(field_of([](auto& r) {
              r.sphere = 8.0;
              r.diameter = 0.07;
            }),
            "diameter");
  EXPECT_EQ(field_of([](auto& r) { r.centre_thickness = 0.0015; }), "centre_thickness");
}

}  // namespace
