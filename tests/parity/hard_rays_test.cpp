// Hard cases of rays, powers and outcomes, on both engines; hard_cases_test.cpp has those of the surfaces and the list
// of what tests/data covers.
#include <nlohmann/json.hpp>

#include "tests/support/de_boor.hpp"
#include "tests/support/hard_case.hpp"
#include "tracking/input_error.hpp"

namespace {

using lenses::RayStatus;
using lenses::Torus;
using lenses::TraceRequest;
using support::even_knots;
using support::HardCase;
using support::kRadians;

TEST_P(HardCase, ContactLensOnTheCornea) {
  // 0.1 mm, 8.6 mm radius, no vertex distance; with the pupil on the back surface as well.
  for (const double depth : {0.00305, 0.0}) {
    for (const double front_radius : {8.0e-3, 8.6e-3, 9.5e-3}) {
      auto request = through(lenses::Sphere{1.0 / front_radius}, lenses::Sphere{1.0 / 8.6e-3}, 0.1);
      request.lens->fit.vertex_distance = 0.0;
      request.lens->diameter = 0.0142;
      request.lens->attached_to = lenses::Lens::AttachedTo::eye;
      request.eye.entrance_pupil_depth = depth;
      expect_axial(request, 1.0 / front_radius, 1.0 / 8.6e-3);
      for (const double up : {-30.0, 8.0, 20.0}) {
        expect_coddington(request, up);
      }
    }
  }
}

TEST_P(HardCase, KissingSurfacesAtTheEdge) {
  // Two paraboloids that meet 20 mm from the axis: 0.5 * 10 * 0.02^2 = 2 mm.
  const auto lens = through(lenses::Conic{10.0, -1.0, {}}, lenses::Plane{}, 2.0);
  EXPECT_EQ(trace(parallel(lens, 19.99, 0.0)).status, RayStatus::ok);
  EXPECT_EQ(trace(parallel(lens, 20.01, 0.0)).status, RayStatus::inverted);
  const auto edge = trace(parallel(lens, 20.0, 0.0)).status;
  EXPECT_TRUE(edge == RayStatus::ok || edge == RayStatus::inverted || edge == RayStatus::miss_front);
  // No thickness at all, the same surface twice.
  EXPECT_EQ(trace(through(lenses::Sphere{5.0}, lenses::Sphere{5.0}, 0.0)).status, RayStatus::inverted);
}

TEST_P(HardCase, CrossedSurfacesAreInverted) {
  EXPECT_EQ(trace(parallel(through(lenses::Sphere{15.0}, lenses::Sphere{2.0}, 0.5), 15.0, 0.0)).status,
            RayStatus::inverted);
  const auto knots = even_knots(-0.05, 0.05, 6, true);
  EXPECT_EQ(
      trace(parallel(through(support::paraboloid(knots, knots, 15.0), lenses::Sphere{2.0}, 0.5), 15.0, 3.0)).status,
      RayStatus::inverted);
}

TEST_P(HardCase, TotalInternalReflection) {
  // Parallel to the axis through a plane back: the front's critical angle is reached where n y c = 1, at 13.33 mm.
  const auto lens = through(lenses::Sphere{50.0}, lenses::Plane{}, 10.0);
  EXPECT_EQ(trace(parallel(lens, 0.0, 13.3)).status, RayStatus::ok);
  EXPECT_EQ(trace(parallel(lens, 0.0, 13.36)).status, RayStatus::tir_front);
}

TEST_P(HardCase, MissesAndRims) {
  auto lens = through(lenses::Sphere{-6.0}, lenses::Sphere{0.0}, 4.0);
  lens.lens->diameter = 0.04;
  EXPECT_EQ(trace(parallel(lens, 19.999, 0.0)).status, RayStatus::ok);
  EXPECT_EQ(trace(parallel(lens, 20.001, 0.0)).status, RayStatus::miss_back);
  EXPECT_EQ(trace(toward(lens, 0.0, 90.0)).status, RayStatus::miss_back);
  auto behind = lens;
  behind.direction = {0.0, 0.0, 1.0};
  EXPECT_EQ(trace(behind).status, RayStatus::miss_back);
  // In through the back near the rim, out through the edge.
  EXPECT_EQ(trace(toward(lens, 0.0, 50.9)).status, RayStatus::miss_front);
}

TEST_P(HardCase, UmbilicsAnd45Degrees) {
  const auto umbilic = trace(through(lenses::Sphere{8.0}, lenses::Sphere{3.0}));
  ASSERT_EQ(umbilic.status, RayStatus::ok);
  EXPECT_LE(umbilic.astigmatism, is_reference() ? 1e-12 : 1e-4);
  if (is_reference()) {
    EXPECT_FALSE(umbilic.axis_deg.has_value());
  }
  const auto request = through(Torus{9.0, 5.0, 45.0 * kRadians}, lenses::Sphere{4.0});
  const double along = axial_vergence(request, 9.0, 4.0);
  const double across = axial_vergence(request, 5.0, 4.0);
  const auto oblique = trace(request);
  expect_vergence(oblique, {0.5 * (along + across), 0.5 * (along - across), 0.5 * (along + across)});
  EXPECT_NEAR(oblique.axis_deg.value_or(-1.0), 45.0, is_reference() ? 1e-10 : 1e-2);
}

TEST_P(HardCase, FociInGlassAndBetweenLensAndEye) {
  // (n - 1) c = 400 D: n / 400 = 3.75 mm behind the front, inside 8 mm of glass.
  auto in_glass = through(lenses::Sphere{800.0}, lenses::Plane{}, 8.0);
  in_glass.lens->diameter = 0.002;
  expect_axial(in_glass, 800.0, 0.0);
  // 80 D: between the lens and the eye. 61 and 64 D: just before and behind the pupil.
  for (const double c : {160.0, 122.0, 128.0, 60.0}) {
    auto between = through(lenses::Sphere{c}, lenses::Plane{}, 1.0);
    between.lens->diameter = 0.006;
    expect_axial(between, c, 0.0);
  }
}

TEST_P(HardCase, ObjectImagedIntoThePupilIsSingular) {
  // Pupil, 16 mm of air, a plane back, no glass to speak of but the front's 125 D: 1/q is where 1/0.016 - 125 ends.
  auto request = through(lenses::Sphere{250.0}, lenses::Plane{}, 0.0);
  request.lens->diameter = 0.002;
  request.lens->centre_thickness = 1.5 / 1024.0;
  request.lens->fit.vertex_distance = 15.0 / 1024.0;  // 16/1024 m in all, reduced: q = 250 * 0.5 - 64 = 61
  request.eye.entrance_pupil_depth = 0.0;
  request.object_distance = 1.0 / 61.0;
  const auto result = trace(request);
  EXPECT_TRUE(result.status == RayStatus::singular || std::abs(result.vergence.x) > (is_reference() ? 1e8 : 1e6));
}

TEST_P(HardCase, ObjectsAtInfinityAtFiveCentimetresAndAtTheFocus) {
  for (const double c : {4.0, 14.0}) {
    for (const double distance : {0.05, 1.0 / (0.5 * c), 1e9, 0.0}) {
      auto request = through(lenses::Sphere{c}, lenses::Plane{}, 2.0);
      request.object_distance = distance > 0.0 ? std::optional(distance) : std::nullopt;
      expect_axial(request, c, 0.0);
    }
  }
}

TEST_P(HardCase, StrongLensesHighIndexAndWideGaze) {
  struct Form {
    double index, front, back, thickness_mm;
  };
  for (const Form& form : {Form{1.5, 60.0, 10.0, 9.0}, Form{1.5, 2.0, 52.0, 1.0}, Form{1.9, 12.0, 2.0, 5.0},
                           Form{1.9, 2.0, 14.0, 1.2}, Form{1.74, 9.0, 5.0, 3.0}}) {
    auto request = through(lenses::Sphere{form.front}, lenses::Sphere{form.back}, form.thickness_mm);
    request.lens->index = form.index;
    for (const double up : {0.0, 10.0, -25.0}) {
      SCOPED_TRACE(testing::Message() << "front " << form.front << ", up " << up);
      expect_coddington(request, up);
    }
    if (form.front < 50.0) {
      request.object_distance = 0.4;
      expect_coddington(request, 40.0);
    }
  }
}

// Along the gaze the ray runs through the centre of rotation: V is Coddington's there, taken back to the turned pupil.
TEST_P(HardCase, FortyDegreesOfGaze) {
  for (const auto& [front, back] : {std::pair(9.0, 3.0), std::pair(4.0, 16.0)}) {
    auto request = toward(through(lenses::Sphere{front}, lenses::Sphere{back}, 3.0), 0.0, 40.0);
    request.viewing = TraceRequest::Viewing::gaze;
    request.gaze = request.direction;
    const auto at_centre =
        support::coddington_vergence({1.5, 0.003, front, back, 0.013 + 0.0135}, 40.0 * kRadians, 0.0);
    const double back_to_pupil = 0.0135 - 0.00305;
    const auto at_pupil = [&](double v) { return v / (1.0 + back_to_pupil * v); };
    expect_vergence(trace(request), {at_pupil(at_centre.sagittal), 0.0, at_pupil(at_centre.tangential)});
  }
}

TEST_P(HardCase, AxisWrapsAt180Degrees) {
  for (const double axis : {0.0, 1e-13, std::numbers::pi - 1e-13, std::numbers::pi, -1e-13}) {
    const auto request = through(Torus{9.0, 5.0, axis}, lenses::Sphere{4.0});
    const auto result = trace(request);
    expect_vergence(result, {axial_vergence(request, 9.0, 4.0), 0.0, axial_vergence(request, 5.0, 4.0)});
    ASSERT_TRUE(result.axis_deg.has_value());
    EXPECT_GE(*result.axis_deg, 0.0);
    EXPECT_LT(*result.axis_deg, 180.0);
    EXPECT_NEAR(std::remainder(*result.axis_deg, 180.0), 0.0, is_reference() ? 1e-10 : 1e-2);
  }
}

TEST_P(HardCase, DirectionsOfAnyLength) {
  const auto lens = through(lenses::Sphere{9.0}, lenses::Sphere{3.0});
  const auto expected = trace(toward(lens, 10.0, 5.0));
  const auto at = [](double scale) {
    const glm::dvec3 d = scale * tracking::direction_from_yaw_pitch(10.0 * kRadians, 5.0 * kRadians);
    nlohmann::json line;
    line["direction"] = {d.x, d.y, d.z};
    return lenses::parse_trace_line(line.dump(), "test", 1, std::string());
  };
  for (const double scale : {1e-300, 1e-20, 3.0, 1e150, 1e300}) {
    TraceRequest request = at(scale);
    request.lens = lens.lens;
    expect_same(trace(request), expected);
  }
  for (const char* bad :
       {R"({"direction": [0, 0, 0]})", R"({"direction": [NaN, 0, -1]})", R"({"direction": [1e999, 0, -1]})",
        R"({"direction": [null, 0, -1]})", R"({"direction": [0, -1]})",
        R"({"direction": [0, 0, -1], "viewing": "gaze", "gaze": [0, 0, 0]})"}) {
    EXPECT_THROW(static_cast<void>(lenses::parse_trace_line(bad, "test", 1, std::string())), tracking::InputError)
        << bad;
  }
}

TEST_P(HardCase, IdenticalLensesGiveIdenticalResults) {
  const auto knots = even_knots(-0.05, 0.05, 7, true);
  const auto one = toward(through(Torus{9.0, 5.0, 1.0}, support::paraboloid(knots, knots, 4.0)), 20.0, -15.0);
  auto other = one;
  other.lens->abbe = 30.0;  // no part of the trace, but another entry in the batch
  const auto results = trace({one, other, one});
  for (const auto& result : results) {
    ASSERT_EQ(result.status, RayStatus::ok);
    EXPECT_EQ(result.vergence, results[0].vergence);
    EXPECT_EQ(result.front_hit, results[0].front_hit);
    EXPECT_EQ(result.object_direction, results[0].object_direction);
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, HardCase, testing::Values(support::Engine::reference, support::Engine::gpu),
                         support::engine_name);

}  // namespace
