// Real rays through a small pupil against the residual: the ray through pupil offset s that meets the chief ray on the
// retina sees what a chief ray sees that is turned by -R s, with R = V + E - I/l. In focus all meet in one object
// point.
#include <gtest/gtest.h>

#include "tests/support/random_lens.hpp"
#include "tests/support/sight.hpp"

namespace {

using support::Random;
using support::Sight;
namespace f64 = lenses::f64;

constexpr std::uint64_t kSeed = 20120613;
constexpr double kOffset = 2e-5;  // m: a hundredth of a pupil

glm::dmat2 symmetric(const glm::dvec3& m) {
  return {m.x, m.y, m.y, m.z};
}

// Where a ray passes the chief ray's object, as an angle seen from the lens, across the chief ray.
glm::dvec3 passage(const Sight& sight, const f64::SightLine& ray) {
  const glm::dvec3 ahead = sight.line.direction_object;
  const double q = sight.inverse_distance();
  // On the plane through the object across the chief ray: start + t d, times q; at infinity its slope.
  const double t_times_q =
      (1.0 - q * glm::dot(ray.start - sight.line.start, ahead)) / glm::dot(ray.direction_object, ahead);
  return q * (ray.start - sight.line.start) + t_times_q * ray.direction_object - ahead;
}

// The linear part of how far apart the two rays pass, over the offset: dioptres.
glm::dvec3 apart(const Sight& sight, const glm::dmat2& excess, const glm::dmat2& residual, const glm::dvec2& offset) {
  const auto difference = [&](const glm::dvec2& s) {
    const auto through_s = sight.beside(s, -(excess * s));
    const auto turned_chief = sight.beside(glm::dvec2(0.0), -(residual * s));
    const bool both = through_s.status == f64::kStatusOk && turned_chief.status == f64::kStatusOk;
    return both ? passage(sight, through_s) - passage(sight, turned_chief) : glm::dvec3(std::nan(""));
  };
  return (difference(offset) - difference(-offset)) / (2.0 * glm::length(offset));
}

class PupilRays : public testing::TestWithParam<std::size_t> {};

TEST_P(PupilRays, AreDisplacedByTheResidual) {
  Random random(kSeed + GetParam());
  int sharp = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", surfaces " << GetParam() << ", lens " << i);
    const std::size_t other = random.pick(support::kSurfaceKinds);
    const Sight sight(ordinary_request(random, support::ordinary_lens(random, GetParam(), other)));
    if (!sight.ok() || sight.largest() > 20.0) {
      continue;
    }
    const glm::dmat2 vergence = symmetric(sight.result.vergence);
    const glm::dmat2 eye = symmetric({random.uniform(-8.0, 8.0), random.uniform(-2.0, 2.0), random.uniform(-8.0, 8.0)});
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const glm::dvec2 s = kOffset * glm::dvec2(std::cos(angle), std::sin(angle));
    for (const bool focused : {false, true}) {
      const glm::dmat2 excess = focused ? -vergence : eye;
      const glm::dvec3 wide = apart(sight, excess, vergence + excess, s);
      const glm::dvec3 narrow = apart(sight, excess, vergence + excess, 0.5 * s);
      if (std::isnan(wide.x + narrow.x)) {
        continue;  // a neighbour falls off the rim
      }
      // What is left is of higher order: a quarter at half the offset, half where a spline's knot lies between.
      const double spread = glm::length(wide - narrow);
      EXPECT_LE(glm::length(narrow), 1e-8 + 1.5 * spread) << (focused ? "in focus" : "out of focus");
      sharp += spread < 1e-5 ? 1 : 0;
    }
  }
  EXPECT_GE(sharp, 150);
}

INSTANTIATE_TEST_SUITE_P(FrontSurfaces, PupilRays, testing::Range(std::size_t{0}, support::kSurfaceKinds),
                         [](const auto& kind) { return support::kSurfaceNames[kind.param]; });

}  // namespace
