// What the ray-transfer matrix must satisfy for every kind of surface: symplectic, V symmetric, equal to the
// derivative of real rays; and that light's path can be walked backwards.
#include <gtest/gtest.h>

#include "tests/support/lens_images.hpp"
#include "tests/support/random_lens.hpp"
#include "tests/support/sight.hpp"

namespace {

using support::Random;
using support::Sight;
namespace f64 = lenses::f64;

constexpr std::uint64_t kSeed = 20120507;

// One pair of surface kinds a test instance: front, back.
class RayTransferProperty : public testing::TestWithParam<std::tuple<std::size_t, std::size_t>> {
 protected:
  RayTransferProperty() : random_(kSeed + 100 * std::get<0>(GetParam()) + std::get<1>(GetParam())) {}

  lenses::TraceRequest next_request() {
    return ordinary_request(random_, support::ordinary_lens(random_, std::get<0>(GetParam()), std::get<1>(GetParam())));
  }

  Random random_;
};

double largest(const glm::dmat2& m) {
  return std::max({std::abs(m[0][0]), std::abs(m[0][1]), std::abs(m[1][0]), std::abs(m[1][1])});
}

TEST_P(RayTransferProperty, IsSymplecticAndGivesASymmetricVergence) {
  int traced = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", lens " << i);
    const Sight sight(next_request());
    if (!sight.ok() || sight.largest() > 1e3) {
      continue;
    }
    ++traced;
    const auto& m = sight.transfer;
    // Rounding of about twenty products of this size.
    const double rounding = 1e-14 * (1.0 + largest(m.a) * largest(m.d) + largest(m.b) * largest(m.c));
    const glm::dmat2 ac = glm::transpose(m.a) * m.c;
    const glm::dmat2 bd = glm::transpose(m.b) * m.d;
    EXPECT_NEAR(ac[0][1], ac[1][0], rounding * (1.0 + largest(m.a) * largest(m.c)));
    EXPECT_NEAR(bd[0][1], bd[1][0], rounding);
    const glm::dmat2 one = glm::transpose(m.a) * m.d - glm::transpose(m.c) * m.b;
    EXPECT_LE(largest(one - glm::dmat2(1.0)), rounding);
    // V's own rounding: 1e-14 of its size, more near the pole, where V itself grows.
    EXPECT_NEAR(sight.record.blur.z, 0.0, 1e-13 * (1.0 + sight.largest() * (1.0 + 0.01 * sight.largest())));
  }
  EXPECT_GE(traced, 30);
}

// How far a real ray passes from the chief ray's object: as a change of its direction, in a basis across it.
class Aim {
 public:
  explicit Aim(const Sight& sight) : sight_(sight) {
    const glm::dvec3 d = sight.line.direction_object;
    across_ = glm::normalize(glm::cross(d, glm::dvec3(0.3, 1.0, 0.1)));
    up_ = glm::cross(across_, d);
  }

  // NaN for a ray that does not pass the lens.
  [[nodiscard]] glm::dvec2 miss(const glm::dvec2& offset, const glm::dvec2& momentum) const {
    const f64::SightLine ray = sight_.beside(offset, momentum);
    if (ray.status != f64::kStatusOk) {
      return glm::dvec2(std::nan(""));
    }
    const double q = sight_.inverse_distance();
    // (object - start) q is the chief direction for an object at infinity.
    const glm::dvec3 to_object = sight_.line.direction_object + q * (sight_.line.start - ray.start);
    const glm::dvec3 miss = glm::cross(glm::normalize(to_object), ray.direction_object);
    return {glm::dot(miss, across_), glm::dot(miss, up_)};
  }

  // The change of direction at the pupil that sends the real ray from `offset` through the object.
  [[nodiscard]] glm::dvec2 momentum_from(const glm::dvec2& offset) const {
    constexpr double kStep = 1e-6;
    glm::dvec2 p(0.0);
    for (int i = 0; i < 8; ++i) {
      const glm::dvec2 x(kStep, 0.0);
      const glm::dvec2 y(0.0, kStep);
      const glm::dmat2 slope((miss(offset, p + x) - miss(offset, p - x)) / (2.0 * kStep),
                             (miss(offset, p + y) - miss(offset, p - y)) / (2.0 * kStep));
      p -= glm::inverse(slope) * miss(offset, p);
    }
    return p;
  }

  struct Difference {
    glm::dmat2 value;   // V, by central differences of two widths (Richardson)
    glm::dmat2 spread;  // between the two widths: more than the value's own error, also where a knot lies between
  };
  // The derivative of that change by the offset.
  [[nodiscard]] Difference vergence(double h) const {
    Difference v{};
    for (int axis = 0; axis < 2; ++axis) {
      const glm::dvec2 step = axis == 0 ? glm::dvec2(h, 0.0) : glm::dvec2(0.0, h);
      const glm::dvec2 wide = (momentum_from(step) - momentum_from(-step)) / (2.0 * h);
      const glm::dvec2 narrow = (momentum_from(0.5 * step) - momentum_from(-0.5 * step)) / h;
      v.value[axis] = (4.0 * narrow - wide) / 3.0;
      v.spread[axis] = wide - narrow;
    }
    return v;
  }

 private:
  const Sight& sight_;
  glm::dvec3 across_{}, up_{};
};

TEST_P(RayTransferProperty, VergenceIsTheDerivativeOfRealRays) {
  int sharp = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", lens " << i);
    const Sight sight(next_request());
    if (!sight.ok() || sight.largest() > 100.0) {
      continue;
    }
    const Aim::Difference v = Aim(sight).vergence(1e-4);
    if (std::isnan(v.value[0][0] + v.value[1][1])) {
      continue;  // a neighbour falls off the rim
    }
    const double spread = largest(v.spread);
    sharp += spread < 1e-4 ? 1 : 0;
    // Rays aimed to 1e-14 rad over 1e-4 m.
    const double tolerance = 1e-9 + spread;
    EXPECT_NEAR(v.value[0][0], sight.result.vergence.x, tolerance);
    EXPECT_NEAR(v.value[0][1], sight.result.vergence.y, tolerance);
    EXPECT_NEAR(v.value[1][0], sight.result.vergence.y, tolerance);
    EXPECT_NEAR(v.value[1][1], sight.result.vergence.z, tolerance);
  }
  EXPECT_GE(sharp, 12);
}

// From a point on the object ray, back through the lens mirrored front to back, to the pupil.
TEST_P(RayTransferProperty, PathsCanBeWalkedBackwards) {
  int traced = 0;
  int through_walls = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", lens " << i);
    const lenses::TraceRequest request = next_request();
    const Sight sight(request);
    if (!sight.ok()) {
      continue;
    }
    ++traced;
    lenses::Lens reversed = *request.lens;
    reversed.front = support::flipped(request.lens->back);
    reversed.back = support::flipped(request.lens->front);
    reversed.front_placement = support::flipped(request.lens->back_placement);
    reversed.back_placement = support::flipped(request.lens->front_placement);
    lenses::LensModel model;
    lenses::append_lens(model, &reversed, request.side, 0.0);
    const double thickness = reversed.centre_thickness;
    const auto mirror = [&](const glm::dvec3& p) { return glm::dvec3(p.x, p.y, -thickness - p.z); };
    const f64::LensPath& path = sight.line.path;
    const glm::dvec3 beyond = path.front_hit + 0.03 * path.direction_object;
    const glm::dvec3 back(-path.direction_object.x, -path.direction_object.y, path.direction_object.z);
    const f64::LensPath home = f64::trace_lens(f64::Table{model.table}, model.lens.front(), mirror(beyond), back);
    // On its way from one surface to the other a path may go through the wall of a ledge, which is nothing to it then,
    // but in reverse stops it or turns it away.
    const bool has_ledge = model.lens.front().back.parts.z + model.lens.front().front.parts.z > 0;
    if (has_ledge && (home.status != f64::kStatusOk || glm::length(home.front_hit - mirror(path.back_hit)) > 1e-12)) {
      ++through_walls;
      continue;
    }
    ASSERT_EQ(home.status, f64::kStatusOk);
    EXPECT_LE(glm::length(home.back_hit - mirror(path.front_hit)), 1e-12);
    EXPECT_LE(glm::length(home.front_hit - mirror(path.back_hit)), 1e-12);
    EXPECT_LE(glm::length(home.front_hit + path.t_back * home.direction_object - mirror(path.start)), 1e-12);
    EXPECT_NEAR(home.t_front, path.t_front, 1e-12);
  }
  EXPECT_GE(traced, 30);
  EXPECT_LE(through_walls, traced / 10);
}

INSTANTIATE_TEST_SUITE_P(FrontAndBack, RayTransferProperty,
                         testing::Combine(testing::Range<std::size_t>(0, support::kSurfaceKinds),
                                          testing::Range<std::size_t>(0, support::kSurfaceKinds)),
                         [](const auto& instance) {
                           return std::string(support::kSurfaceNames[std::get<0>(instance.param)]) + "_then_" +
                                  support::kSurfaceNames[std::get<1>(instance.param)];
                         });

}  // namespace
