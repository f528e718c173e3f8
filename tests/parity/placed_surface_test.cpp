// Surfaces that are decentred, sloped or lifted, on both engines, against closed forms (Snell's law at two planes,
// Prentice's rule), against the same lens tilted as a whole, and against the same surface written differently.
#include "tests/support/de_boor.hpp"
#include "tests/support/hard_case.hpp"

namespace {

using lenses::Placement;
using lenses::RayStatus;
using lenses::TraceRequest;
using support::even_knots;
using support::kRadians;

class PlacedSurface : public support::HardCase {
 protected:
  // Where a float engine's direction is held to: a few roundings of a unit vector.
  static double radians() { return is_reference() ? 1e-14 : 1e-6; }

  static std::vector<TraceRequest> from_everywhere(const TraceRequest& request) {
    std::vector<TraceRequest> requests;
    for (const double right : {-35.0, -9.0, 0.0, 14.0, 40.0}) {
      for (const double up : {-30.0, 0.0, 12.0, 33.0}) {
        requests.push_back(toward(request, right, up));
      }
    }
    return requests;
  }
  // All rays of one lens give what those of another give, and at least some of them pass.
  static void expect_same_lens(const std::vector<std::pair<TraceRequest, TraceRequest>>& lenses) {
    std::vector<TraceRequest> first, second;
    for (const auto& [one, other] : lenses) {
      const auto a = from_everywhere(one);
      const auto b = from_everywhere(other);
      first.insert(first.end(), a.begin(), a.end());
      second.insert(second.end(), b.begin(), b.end());
    }
    const auto results = trace(first);
    const auto others = trace(second);
    std::size_t passed = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
      SCOPED_TRACE(testing::Message() << "lens " << i / 20 << ", ray " << i % 20);
      expect_same(results[i], others[i]);
      passed += results[i].status == RayStatus::ok ? 1 : 0;
    }
    EXPECT_GE(passed, results.size() / 2);
  }
};

// One of every shape, none of them flat.
std::vector<lenses::Surface> shapes() {
  const auto knots = even_knots(-0.06, 0.06, 9, true);
  return {lenses::Sphere{6.0},
          lenses::Conic{7.0, -0.4, {20.0}},
          lenses::Torus{4.0, 8.0, 0.4, lenses::Torus::Revolve::u},
          lenses::Torus{8.0, 4.0, 0.4, lenses::Torus::Revolve::v},
          support::paraboloid(knots, knots, 6.0),
          support::parametric_paraboloid(knots, knots, 6.0)};
}

// From index n into index n2 through a plane of the given slope (z = slope . (x, y)), travelling towards -z; NaN at
// total reflection.
glm::dvec3 snell(const glm::dvec3& d, const glm::dvec2& slope, double n, double n2) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(slope, -1.0));
  const glm::dvec3 along = n / n2 * (d - glm::dot(d, normal) * normal);
  return along + std::sqrt(1.0 - glm::dot(along, along)) * normal;
}

TEST_P(PlacedSurface, AWedgeDeviatesAsTwoPlanesDo) {
  std::vector<TraceRequest> requests;
  for (const glm::dvec2& back : {glm::dvec2(0.0), glm::dvec2(0.1, 0.0), glm::dvec2(-0.05, 0.2)}) {
    for (const glm::dvec2& front : {glm::dvec2(0.15, -0.1), glm::dvec2(0.0)}) {
      auto request = through(lenses::Plane{}, lenses::Plane{}, 20.0);
      request.lens->back_placement.slope = back;
      request.lens->front_placement.slope = front;
      const auto rays = from_everywhere(request);
      requests.insert(requests.end(), rays.begin(), rays.end());
    }
  }
  const auto results = trace(requests);
  int passed = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "lens " << i / 20 << ", ray " << i % 20);
    const lenses::Lens& lens = *requests[i].lens;
    const glm::dvec3 in_glass = snell(glm::normalize(requests[i].direction), lens.back_placement.slope, 1.0, 1.5);
    const glm::dvec3 expected = snell(in_glass, lens.front_placement.slope, 1.5, 1.0);
    if (std::isnan(expected.z)) {
      EXPECT_EQ(results[i].status, RayStatus::tir_front);
      continue;
    }
    ++passed;
    ASSERT_EQ(results[i].status, RayStatus::ok);
    EXPECT_LE(glm::length(results[i].object_direction - expected), radians());
    expect_vergence(results[i], glm::dvec3(0.0));
  }
  EXPECT_GE(passed, 110);
}

// The base is where the glass is thicker, and outgoing rays turn towards it: by (n - 1) times the slope. The third
// order adds about the square of the slope.
TEST_P(PlacedSurface, ASlopeIsPrism) {
  constexpr double kSlope = 0.02;
  auto back = through(lenses::Sphere{8.0}, lenses::Sphere{2.0}, 0.0);
  back.lens->centre_thickness = 1e-5;
  auto front = back;
  back.lens->back_placement.slope = {kSlope, 0.0};
  front.lens->front_placement.slope = {0.0, kSlope};
  const auto results = trace({back, front});
  EXPECT_NEAR(results[0].object_direction.x, 0.5 * kSlope, 1e-3 * 0.5 * kSlope);
  EXPECT_NEAR(results[0].object_direction.y, 0.0, 1e-6);
  EXPECT_NEAR(results[1].object_direction.y, -0.5 * kSlope, 1e-3 * 0.5 * kSlope);
  EXPECT_NEAR(results[1].object_direction.x, 0.0, 1e-6);
}

// Prentice's rule for a ray parallel to the axis: the equivalent power times the distance from the axis. 1 mm off it
// the third order is below 1e-3 of that.
TEST_P(PlacedSurface, DecentrationObeysPrenticesRule) {
  for (const double front : {14.0, 2.0}) {
    constexpr double kBack = 6.0;
    auto request = through(lenses::Sphere{front}, lenses::Sphere{kBack});
    const Placement placement{{0.001, -0.0005}, {0.0, 0.0}, 0.0};
    request.lens->front_placement = placement;
    request.lens->back_placement = placement;
    const double f1 = 0.5 * front;
    const double f2 = -0.5 * kBack;
    const double power = f1 + f2 - 0.003 / 1.5 * f1 * f2;
    const auto result = trace(request);
    ASSERT_EQ(result.status, RayStatus::ok);
    EXPECT_NEAR(result.object_direction.x, 0.001 * power, 1e-6 * std::abs(power));
    EXPECT_NEAR(result.object_direction.y, -0.0005 * power, 1e-6 * std::abs(power));
  }
}

// Two spheres are a centred lens about the line through their centres: tilted as a whole, the lens is one whose
// surfaces are decentred.
TEST_P(PlacedSurface, DecentredSpheresAreATiltedLens) {
  std::vector<std::pair<TraceRequest, TraceRequest>> pairs;
  for (const double tilt : {-12.0 * kRadians, 4.0 * kRadians, 20.0 * kRadians}) {
    constexpr double kFront = 7.0;
    constexpr double kBack = 5.0;
    auto tilted = through(lenses::Sphere{kFront}, lenses::Sphere{kBack}, 8.0);
    tilted.lens->diameter = 0.2;  // the two rims differ
    tilted.lens->fit.pantoscopic_tilt = tilt;
    tilted.lens->fit.vertex_distance = 0.03;
    auto upright = tilted;
    upright.lens->fit.pantoscopic_tilt = 0.0;
    // Centres from the back vertex, in the axes of the eye; a positive tilt lifts what is behind the vertex.
    const glm::dvec2 axis(std::sin(tilt), std::cos(tilt));  // y, z
    const glm::dvec2 back = axis / kBack;
    const glm::dvec2 front = axis * (1.0 / kFront - 0.008);
    upright.lens->back_placement = {{0.0, back.x}, {0.0, 0.0}, back.y - 1.0 / kBack};
    upright.lens->front_placement.decentration.y = front.x;
    upright.lens->centre_thickness = 1.0 / kFront - front.y;
    pairs.emplace_back(tilted, upright);
  }
  expect_same_lens(pairs);
}

TEST_P(PlacedSurface, BothSurfacesDecentredIsTheLensDecentred) {
  std::vector<std::pair<TraceRequest, TraceRequest>> pairs;
  for (const auto& shape : shapes()) {
    auto placed = through(shape, shape, 6.0);
    placed.lens->diameter = 0.12;
    auto moved = placed;
    moved.lens->fit.decentration = {0.004, -0.003};
    placed.lens->front_placement.decentration = moved.lens->fit.decentration;
    placed.lens->back_placement.decentration = moved.lens->fit.decentration;
    pairs.emplace_back(placed, moved);
  }
  expect_same_lens(pairs);
}

TEST_P(PlacedSurface, HeightsMakeThicknessAndVertexDistance) {
  std::vector<std::pair<TraceRequest, TraceRequest>> pairs;
  for (const auto& shape : shapes()) {
    auto placed = through(shape, shape, 6.0);
    auto moved = placed;
    placed.lens->front_placement.height = -0.0015;
    placed.lens->back_placement.height = 0.001;
    moved.lens->centre_thickness += 0.0025;
    moved.lens->fit.vertex_distance -= 0.001;
    pairs.emplace_back(placed, moved);
  }
  expect_same_lens(pairs);
}

// c (x - a)^2 / 2 = c x^2 / 2 - c a x + c a^2 / 2: a decentred paraboloid is a sloped and lifted one.
TEST_P(PlacedSurface, DecentrationOfAParaboloidIsASlopeAndAHeight) {
  const auto knots = even_knots(-0.06, 0.06, 9, true);
  constexpr double kCurvature = 6.0;
  const glm::dvec2 a(0.005, -0.007);
  const Placement decentred{a, {0.0, 0.0}, 0.0};
  const Placement sloped{{0.0, 0.0}, -kCurvature * a, 0.5 * kCurvature * glm::dot(a, a)};
  const lenses::Surface conic = lenses::Conic{kCurvature, -1.0, {}};
  auto expected = through(lenses::Sphere{9.0}, conic, 8.0);
  expected.lens->diameter = 0.05;  // well inside every patch
  expected.lens->back_placement = decentred;
  std::vector<std::pair<TraceRequest, TraceRequest>> pairs;
  for (const lenses::Surface& shape : {conic, lenses::Surface(support::paraboloid(knots, knots, kCurvature)),
                                       lenses::Surface(support::parametric_paraboloid(knots, knots, kCurvature))}) {
    for (const Placement& placement : {decentred, sloped}) {
      auto other = expected;
      other.lens->back = shape;
      other.lens->back_placement = placement;
      pairs.emplace_back(other, expected);
    }
  }
  expect_same_lens(pairs);
}

// The sphere's crossing is in closed form, the conic's and the torus's by Newton's method: steeply sloped, they agree.
TEST_P(PlacedSurface, OneSphereHoweverItIsWrittenAndSloped) {
  std::vector<std::pair<TraceRequest, TraceRequest>> pairs;
  for (const double c : {-6.0, 0.0, 6.0}) {
    for (const glm::dvec2& slope : {glm::dvec2(0.3, -0.2), glm::dvec2(-0.6, 0.0)}) {
      auto sphere = through(lenses::Plane{}, lenses::Sphere{c}, 30.0);
      sphere.lens->diameter = 0.1;
      sphere.lens->fit.vertex_distance = 0.03;
      sphere.lens->back_placement = {{0.003, 0.001}, slope, 0.0005};
      sphere.lens->front_placement.slope = slope;
      for (const lenses::Surface& other : {lenses::Surface(lenses::Conic{c, 0.0, {}}),
                                           lenses::Surface(lenses::Torus{c, c, 0.3, lenses::Torus::Revolve::v})}) {
        auto same = sphere;
        same.lens->back = other;
        pairs.emplace_back(same, sphere);
      }
    }
  }
  expect_same_lens(pairs);
}

// In float, a lens without prism between lenses with it still gives what it gives alone.
TEST_P(PlacedSurface, LeavesItsNeighboursInABatchAlone) {
  const auto plain = toward(through(lenses::Sphere{9.0}, lenses::Torus{3.0, 4.0, 0.3}), 10.0, 15.0);
  auto placed = plain;
  placed.lens->back_placement = {{0.002, 0.0}, {0.05, 0.02}, 1e-4};
  auto segmented = plain;
  segmented.lens->front = lenses::SegmentedSurface{lenses::Sphere{9.0},
                                                   lenses::Sphere{13.0},
                                                   {{0.0, -0.006}, {}, 0.0},
                                                   {{-0.014, -0.003}, {0.014, -0.003}, {0.0, -0.02}}};
  const auto alone = trace(plain);
  const auto together = trace({placed, plain, segmented});
  EXPECT_EQ(together[1].vergence, alone.vergence);
  EXPECT_EQ(together[1].front_hit, alone.front_hit);
  EXPECT_NE(together[0].front_hit, alone.front_hit);
}

INSTANTIATE_TEST_SUITE_P(Engines, PlacedSurface, testing::Values(support::Engine::reference, support::Engine::gpu),
                         support::engine_name);

}  // namespace
