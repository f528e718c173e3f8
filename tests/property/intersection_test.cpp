// A ray meets a surface where a fine walk along it first finds it crossing to the far side, for every kind of surface,
// at any incidence, from within the lens's cylinder or far beside it.
#include <gtest/gtest.h>

#include "lenses/lens_model.hpp"
#include "tests/support/random_lens.hpp"

namespace {

using support::kRadians;
using support::Random;
namespace f64 = lenses::f64;

constexpr std::uint64_t kSeed = 1966;
constexpr int kSteps = 1500;

struct Scene {
  lenses::LensModel model;
  glm::dvec3 start;
  double radius;

  [[nodiscard]] const f64::LensData& lens() const { return model.lens.front(); }

  // Height above the back surface, or NaN outside the lens's cylinder or the patch.
  [[nodiscard]] double above(const glm::dvec3& p) const {
    if (p.x * p.x + p.y * p.y > radius * radius) {
      return std::nan("");
    }
    const auto point = f64::surface_point(f64::Table{model.table}, lens().back, glm::dvec2(p));
    return point.inside ? p.z - point.z : std::nan("");
  }

  enum class Met { nothing, surface, wall };

  // What a walk of length `end` first passes from outside to inside: the surface, or a ledge's wall between two steps.
  // (Into a segmented surface's solid it may also have come through the rim; then it meets nothing.)
  [[nodiscard]] Met walk(const glm::dvec3& direction, double end) const {
    const bool segmented = lens().back.parts.z > 0;
    double last = std::nan("");
    bool last_part = false;
    for (int i = 0; i <= kSteps; ++i) {
      const glm::dvec3 p = start + end * i / kSteps * direction;
      const double f = above(p);
      const bool part = segmented && f64::in_segment(f64::Table{model.table}, lens().back, glm::dvec2(p));
      if (f <= 0.0 && (last > 0.0 || segmented)) {
        return !(last > 0.0) ? Met::nothing : part == last_part ? Met::surface : Met::wall;
      }
      last = f;
      last_part = part;
    }
    return Met::nothing;
  }
};

class IntersectionProperty : public testing::TestWithParam<std::size_t> {};

TEST_P(IntersectionProperty, IsTheFirstCrossingAlongTheRay) {
  Random random(kSeed + GetParam());
  int hits = 0;
  int misses = 0;
  int ledges = 0;
  for (int i = 0; i < 60; ++i) {
    lenses::Lens lens = support::ordinary_lens(random, 1, GetParam());
    if (i % 2 == 1) {  // small and far to the side
      lens.diameter = random.uniform(0.008, 0.03);
      lens.fit.decentration = {random.uniform(-0.09, 0.09), random.uniform(-0.09, 0.09)};
    }
    Scene scene{{}, {}, 0.5 * lens.diameter};
    lenses::append_lens(scene.model, &lens, lenses::Side::right, 0.003);
    scene.start = f64::to_lens_point(scene.lens(), glm::dvec3(0.0));
    for (int k = 0; k < 30; ++k) {
      SCOPED_TRACE(testing::Message() << "seed " << kSeed + GetParam() << ", lens " << i << ", ray " << k);
      const double reach = 0.6 * lens.diameter;
      const glm::dvec3 aim(random.uniform(-reach, reach), random.uniform(-reach, reach), 0.0);
      const glm::dvec3 direction = k % 2 == 0
                                       ? glm::normalize(aim - scene.start)
                                       : f64::to_lens_direction(scene.lens(), random.direction_ahead(75.0 * kRadians));
      const double far = glm::length(scene.start) + 2.0 * lens.diameter;
      const auto path = f64::trace_lens(f64::Table{scene.model.table}, scene.lens(), scene.start, direction);
      if (path.status == f64::kStatusMissBack) {
        ++misses;
        EXPECT_NE(scene.walk(direction, far), Scene::Met::surface);
        continue;
      }
      if (f64::intersect_surface(f64::Table{scene.model.table}, scene.lens().back, scene.start, direction, scene.radius)
              .ledge) {
        EXPECT_EQ(path.status, f64::kStatusMissFront);
        EXPECT_EQ(scene.walk(direction, far), Scene::Met::wall);
        ++ledges;
        continue;
      }
      ++hits;
      EXPECT_NEAR(scene.above(path.back_hit), 0.0, 1e-15);
      EXPECT_NE(scene.walk(direction, path.t_back * (1.0 - 1e-7)), Scene::Met::surface);
    }
  }
  EXPECT_GE(hits, 300);
  EXPECT_GE(misses, 200);
  EXPECT_EQ(ledges > 0, GetParam() == support::kSegmentedKind);
}

INSTANTIATE_TEST_SUITE_P(Back, IntersectionProperty, testing::Range<std::size_t>(0, support::kSurfaceKinds),
                         [](const auto& instance) { return std::string(support::kSurfaceNames[instance.param]); });

}  // namespace
