// Bifocals, on both engines: each side of the boundary is its own single lens, the image jumps at the boundary as
// Prentice's rule says, a ledge stops light, and a segment like its base changes nothing.
#include "tests/support/de_boor.hpp"
#include "tests/support/hard_case.hpp"

namespace {

using lenses::Placement;
using lenses::RayStatus;
using lenses::SegmentedSurface;
using lenses::TraceRequest;
using support::Random;

constexpr std::uint64_t kSeed = 1784;

class SegmentedLens : public support::HardCase {};

// A flat-top 28: 28 mm across, its top 5 mm above the segment's own centre, that centre `below` the lens's.
std::vector<glm::dvec2> flat_top(double below) {
  constexpr double kRadius = 0.014;
  constexpr double kTop = 0.005;
  std::vector<glm::dvec2> boundary;
  const double start = std::asin(kTop / kRadius);
  constexpr int kCorners = 96;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = start - (std::numbers::pi + 2.0 * start) * i / kCorners;
    boundary.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle) - below);
  }
  return boundary;
}

// By the winding of the corners around the point, as in_segment does not do it.
bool winds_around(const std::vector<glm::dvec2>& boundary, const glm::dvec2& p) {
  double turned = 0.0;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const glm::dvec2 a = boundary[i] - p;
    const glm::dvec2 b = boundary[(i + 1) % boundary.size()] - p;
    turned += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
  }
  return std::abs(turned) > std::numbers::pi;
}

// A front of 6 D with an addition of 2 D at index 1.5; where base and segment meet at the segment's optical centre.
TraceRequest bifocal(TraceRequest request) {
  const double base_sag_slope = 12.0 * -0.01;
  const double base_sag = 0.5 * 12.0 * 0.01 * 0.01;
  // The segment's vertex on the base, its axis there along the base's normal.
  const Placement placement{{0.0, -0.01}, {0.0, base_sag_slope}, base_sag - base_sag_slope * -0.01};
  request.lens->front = SegmentedSurface{lenses::Sphere{12.0}, lenses::Sphere{16.0}, placement, flat_top(0.01)};
  return request;
}
TraceRequest base_alone(TraceRequest request) {
  request.lens->front = lenses::Sphere{12.0};
  return request;
}
TraceRequest segment_alone(TraceRequest request) {
  const auto segmented = std::get<SegmentedSurface>(bifocal(request).lens->front);
  request.lens->front = lenses::Sphere{16.0};
  request.lens->front_placement = segmented.segment_placement;
  return request;
}

TEST_P(SegmentedLens, EachSideOfTheBoundaryIsItsOwnSingleLens) {
  Random random(kSeed);
  const auto lens = through(lenses::Plane{}, lenses::Sphere{6.0}, 4.0);
  const auto boundary = flat_top(0.01);
  std::vector<TraceRequest> both, base, segment;
  for (int i = 0; i < 600; ++i) {
    const auto aimed = toward(lens, random.uniform(-30.0, 30.0), random.uniform(-50.0, 15.0));
    both.push_back(bifocal(aimed));
    base.push_back(base_alone(aimed));
    segment.push_back(segment_alone(aimed));
  }
  const auto as_both = trace(both);
  const auto as_base = trace(base);
  const auto as_segment = trace(segment);
  int in_base = 0;
  int in_segment = 0;
  for (std::size_t i = 0; i < both.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", ray " << i);
    const bool base_counts = !winds_around(boundary, glm::dvec2(as_base[i].front_hit));
    const bool segment_counts = winds_around(boundary, glm::dvec2(as_segment[i].front_hit));
    if (base_counts == segment_counts) {
      continue;  // by the ledge
    }
    expect_same(as_both[i], base_counts ? as_base[i] : as_segment[i]);
    (base_counts ? in_base : in_segment) += 1;
  }
  EXPECT_GE(in_base, 150);
  EXPECT_GE(in_segment, 150);
}

// Prentice: 5 mm from the top of the segment to its optical centre, 2 D: 1 prism dioptre, base down.
TEST_P(SegmentedLens, TheImageJumpsAtTheBoundary) {
  // The ray of a centred pupil that passes the front at the segment's top, found on the base alone.
  const auto lens = through(lenses::Plane{}, lenses::Sphere{6.0}, 4.0);
  double low = -40.0;
  double high = 0.0;
  for (int i = 0; i < 50; ++i) {
    const double up = 0.5 * (low + high);
    (trace(base_alone(toward(lens, 0.0, up))).front_hit.y < -0.005 ? low : high) = up;
  }
  // Just above, and just below the ledge of 0.05 mm.
  const double up_above = high + 1e-3;
  const double up_below = high - 0.1;
  const auto above = trace(bifocal(toward(lens, 0.0, up_above)));
  const auto below = trace(bifocal(toward(lens, 0.0, up_below)));
  ASSERT_EQ(above.status, RayStatus::ok);
  ASSERT_EQ(below.status, RayStatus::ok);
  const auto deviation = [](const lenses::TraceResult& r, double up_deg) {
    return std::asin(r.object_direction.y) - up_deg * support::kRadians;
  };
  // Rays turn down, to the base, so that the image jumps up. Prentice's rule is paraxial; this ray leaves the front at
  // 20 degrees, which adds some hundredths.
  EXPECT_NEAR(deviation(above, up_above) - deviation(below, up_below), 0.01, 6e-4);
  EXPECT_GT(below.vergence.x - above.vergence.x, 1.5) << "the addition";
  EXPECT_GT(below.vergence.z - above.vergence.z, 1.5) << "the addition";
}

// Aimed at corners and edges themselves too: wherever rounding puts a hit, some surface takes it.
TEST_P(SegmentedLens, ASegmentLikeItsBaseChangesNothing) {
  Random random(kSeed);
  const auto knots = support::even_knots(-0.05, 0.05, 8, true);
  const std::vector<lenses::BasicSurface> shapes{lenses::Plane{},
                                                 lenses::Sphere{8.0},
                                                 lenses::Conic{8.0, -0.5, {30.0}},
                                                 lenses::Torus{9.0, 6.0, 0.3},
                                                 support::paraboloid(knots, knots, 7.0),
                                                 support::parametric_paraboloid(knots, knots, 7.0)};
  const Placement placement{{0.001, 0.002}, {0.02, -0.03}, 1e-4};
  std::vector<std::pair<TraceRequest, TraceRequest>> pairs;
  for (const auto& shape : shapes) {
    auto plain = through(lenses::Sphere{10.0}, lenses::Plane{}, 6.0);
    plain.lens->back = std::visit([](const auto& s) { return lenses::Surface(s); }, shape);
    plain.lens->back_placement = placement;
    for (int k = 0; k < 4; ++k) {
      auto segmented = plain;
      const auto boundary = support::ordinary_boundary(random);
      segmented.lens->back = SegmentedSurface{shape, shape, {}, boundary};
      for (const bool parallel_ray : {true, false}) {
        for (std::size_t i = 0; i + 1 < std::min<std::size_t>(boundary.size(), 12); ++i) {
          const glm::dvec2 at = i % 2 == 0 ? boundary[i] : 0.5 * (boundary[i] + boundary[i + 1]);
          if (parallel_ray) {
            pairs.emplace_back(parallel(segmented, 1e3 * at.x, 1e3 * at.y), parallel(plain, 1e3 * at.x, 1e3 * at.y));
          } else {
            segmented.direction = plain.direction = {at.x, at.y, -0.01605};
            pairs.emplace_back(segmented, plain);
          }
        }
      }
    }
  }
  const auto is_ok = [](const lenses::TraceResult& r) { return r.status == RayStatus::ok; };
  std::vector<TraceRequest> plain;
  for (const auto& pair : pairs) {
    plain.push_back(pair.second);
  }
  EXPECT_GE(std::ranges::count_if(trace(plain), is_ok), static_cast<std::ptrdiff_t>(pairs.size() * 3 / 4));
  expect_same(pairs);
}

// A plane plate whose lower half is half a millimetre thinner, on its front or on its back. Rays that climb out of that
// half on the air side, or down into it on the glass side, meet the wall: over 0.5 mm times their slope, which at 30
// degrees is 0.577350 in air and 0.353553 in the glass.
TEST_P(SegmentedLens, ALedgeStopsLight) {
  const std::vector<glm::dvec2> lower_half{{-0.05, 0.0}, {-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.0}};
  struct Ray {
    bool on_front;
    double up_deg;
    double height_um;  // above the edge, where the ray meets the thicker half's plane
    RayStatus expected;
  };
  const std::vector<Ray> rays{{true, -30.0, 1.0, RayStatus::ok},
                              {true, -30.0, -1.0, RayStatus::miss_front},
                              {true, -30.0, -175.0, RayStatus::miss_front},
                              {true, -30.0, -178.0, RayStatus::ok},
                              {true, 30.0, 1.0, RayStatus::ok},
                              {true, 30.0, -1.0, RayStatus::ok},
                              {true, 30.0, 175.0, RayStatus::ok},
                              {true, 30.0, 178.0, RayStatus::ok},
                              {false, 30.0, 1.0, RayStatus::ok},
                              {false, 30.0, -1.0, RayStatus::miss_front},
                              {false, 30.0, -287.0, RayStatus::miss_front},
                              {false, 30.0, -290.0, RayStatus::ok},
                              {false, -30.0, 1.0, RayStatus::ok},
                              {false, -30.0, -1.0, RayStatus::ok},
                              {false, -30.0, 287.0, RayStatus::ok},
                              {false, -30.0, -290.0, RayStatus::ok}};
  std::vector<TraceRequest> requests;
  for (const Ray& ray : rays) {
    auto request = through(lenses::Plane{}, lenses::Plane{}, 4.0);
    const double thinner = ray.on_front ? 0.0005 : -0.0005;
    (ray.on_front ? request.lens->front : request.lens->back) =
        SegmentedSurface{lenses::Plane{}, lenses::Plane{}, {{}, {}, thinner}, lower_half};
    const double sine = std::sin(ray.up_deg * support::kRadians);
    const double in_glass = sine / std::sqrt(2.25 - sine * sine);
    const double height = 0.01605 * std::tan(ray.up_deg * support::kRadians) + (ray.on_front ? 0.004 * in_glass : 0.0);
    request.lens->fit.decentration.y = height - 1e-6 * ray.height_um;
    requests.push_back(toward(request, 0.0, ray.up_deg));
  }
  const auto results = trace(requests);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(results[i].status, rays[i].expected)
        << (rays[i].on_front ? "front, " : "back, ") << rays[i].up_deg << " degrees, " << rays[i].height_um << " um";
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, SegmentedLens, testing::Values(support::Engine::reference, support::Engine::gpu),
                         support::engine_name);

}  // namespace
