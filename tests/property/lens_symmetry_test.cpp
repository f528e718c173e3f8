// Changes of a lens that must change nothing, or change it in a known way: scale, mirror images, the two ways to write
// a torus, turning about the axis, glass of index 1.
#include <gtest/gtest.h>

#include "tests/support/lens_images.hpp"
#include "tests/support/random_lens.hpp"
#include "tests/support/sight.hpp"

namespace {

using support::expect_same_vergence;
using support::Random;
using support::Sight;

constexpr std::uint64_t kSeed = 18410413;
constexpr int kLenses = 400;
constexpr double kMostDioptres = 100.0;

// Calls check(request, its sight) for random ordinary lenses whose ray passes.
template <class Check>
void for_each_sight(const Check& check) {
  Random random(kSeed);
  int traced = 0;
  for (int i = 0; i < kLenses; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", lens " << i);
    const lenses::TraceRequest request = ordinary_request(random, support::ordinary_lens(random));
    const Sight sight(request);
    if (sight.ok() && sight.largest() < kMostDioptres) {
      ++traced;
      check(request, sight);
    }
  }
  EXPECT_GE(traced, kLenses / 3);
}

TEST(LensSymmetry, LengthsScaleDioptresInversely) {
  for_each_sight([](const lenses::TraceRequest& request, const Sight& sight) {
    for (const double s : {0.5, 3.0}) {
      lenses::TraceRequest large = request;
      large.lens = support::scaled(*request.lens, s);
      large.eye.entrance_pupil_depth *= s;
      large.eye.centre_of_rotation_depth *= s;
      if (request.object_distance) {
        large.object_distance = *request.object_distance * s;
      }
      const Sight image(large);
      ASSERT_TRUE(image.ok());
      // 1e-11 of the largest vergence: rounding of positions at 1e-16 over the lens's power.
      expect_same_vergence(image.result.vergence * s, sight.result.vergence, 1e-9);
      EXPECT_LE(glm::length(image.result.back_hit / s - sight.result.back_hit), 1e-14);
      EXPECT_LE(glm::length(image.result.front_hit / s - sight.result.front_hit), 1e-14);
      EXPECT_LE(glm::length(image.result.object_direction - sight.result.object_direction), 1e-13);
    }
  });
}

TEST(LensSymmetry, TheOtherEyeSeesTheMirrorImage) {
  for_each_sight([](const lenses::TraceRequest& request, const Sight& sight) {
    lenses::TraceRequest other = request;
    other.lens = support::mirrored(*request.lens);
    other.side = request.side == lenses::Side::right ? lenses::Side::left : lenses::Side::right;
    other.direction.x = -request.direction.x;
    other.gaze.x = -request.gaze.x;
    const Sight image(other);
    ASSERT_TRUE(image.ok());
    const glm::dvec3 v = sight.result.vergence;
    expect_same_vergence(image.result.vergence, {v.x, -v.y, v.z}, 1e-9);
    const glm::dvec3 flip(-1.0, 1.0, 1.0);
    EXPECT_LE(glm::length(image.result.back_hit - flip * sight.result.back_hit), 1e-14);
    EXPECT_LE(glm::length(image.result.front_hit - flip * sight.result.front_hit), 1e-14);
    EXPECT_LE(glm::length(image.result.object_direction - flip * sight.result.object_direction), 1e-13);
  });
}

lenses::Surface transposed(const lenses::Surface& surface) {
  lenses::Surface out = surface;
  if (auto* torus = std::get_if<lenses::Torus>(&out)) {
    std::swap(torus->curvature_u, torus->curvature_v);
    torus->axis += 0.5 * std::numbers::pi;
    torus->revolve =
        torus->revolve == lenses::Torus::Revolve::u ? lenses::Torus::Revolve::v : lenses::Torus::Revolve::u;
  }
  return out;
}

TEST(LensSymmetry, PlusAndMinusCylinderFormsAreOneSurface) {
  Random random(kSeed);
  int traced = 0;
  for (int i = 0; i < kLenses; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", lens " << i);
    lenses::TraceRequest request = ordinary_request(random, support::ordinary_lens(random, 3, 3));
    const Sight sight(request);
    if (!sight.ok() || sight.largest() > kMostDioptres) {
      continue;
    }
    ++traced;
    request.lens->front = transposed(request.lens->front);
    request.lens->back = transposed(request.lens->back);
    const Sight same(request);
    ASSERT_TRUE(same.ok());
    expect_same_vergence(same.result.vergence, sight.result.vergence, 1e-10);
    EXPECT_LE(glm::length(same.result.front_hit - sight.result.front_hit), 1e-15);
    // Half a turn of the axis brings the torus back.
    std::get<lenses::Torus>(request.lens->back).axis += std::numbers::pi;
    const Sight turned(request);
    ASSERT_TRUE(turned.ok());
    expect_same_vergence(turned.result.vergence, sight.result.vergence, 1e-10);
  }
  EXPECT_GE(traced, kLenses / 3);
}

TEST(LensSymmetry, IndexOneIsNoLens) {
  Random random(kSeed);
  int traced = 0;
  for (int i = 0; i < kLenses; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", lens " << i);
    lenses::TraceRequest request = ordinary_request(random, support::ordinary_lens(random));
    request.lens->index = 1.0;
    const Sight sight(request);
    if (!sight.ok()) {
      continue;
    }
    ++traced;
    EXPECT_LE(sight.result.deviation, 1e-14);
    const double to_front = glm::length(sight.line.start - sight.line.pupil);
    const double v = request.object_distance ? -1.0 / (to_front + *request.object_distance) : 0.0;
    expect_same_vergence(sight.result.vergence, {v, 0.0, v}, 1e-11);
  }
  EXPECT_GE(traced, kLenses / 3);
}

// V as a tensor in space, free of the basis e_h, e_v.
glm::dmat3 vergence_in_space(const Sight& sight) {
  const auto& v = sight.result.vergence;
  const glm::dvec3 h = sight.line.e_h;
  const glm::dvec3 u = sight.line.e_v;
  return v.x * glm::outerProduct(h, h) + v.y * (glm::outerProduct(h, u) + glm::outerProduct(u, h)) +
         v.z * glm::outerProduct(u, u);
}

TEST(LensSymmetry, TurningLensAndRayTogetherTurnsTheVergence) {
  Random random(kSeed);
  int traced = 0;
  for (int i = 0; i < kLenses; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", lens " << i);
    const std::size_t back_kind = 1 + random.pick(3);  // sphere, conic, torus
    lenses::Lens lens = support::ordinary_lens(random, 1 + random.pick(3), back_kind);
    lens.fit.decentration = glm::dvec2(0.0);
    lens.fit.pantoscopic_tilt = 0.0;
    lens.fit.wrap = 0.0;
    lenses::TraceRequest request = ordinary_request(random, lens);
    const double angle = random.uniform(-4.0, 4.0);
    const glm::dmat3 turn({std::cos(angle), std::sin(angle), 0.0}, {-std::sin(angle), std::cos(angle), 0.0},
                          {0.0, 0.0, 1.0});
    const Sight sight(request);
    if (!sight.ok() || sight.largest() > kMostDioptres) {
      continue;
    }
    ++traced;
    for (auto* surface : {&request.lens->front, &request.lens->back}) {
      if (auto* torus = std::get_if<lenses::Torus>(surface)) {
        torus->axis += angle;
      }
    }
    request.direction = turn * request.direction;
    request.gaze = turn * request.gaze;
    const Sight turned(request);
    ASSERT_TRUE(turned.ok());
    EXPECT_LE(glm::length(turned.result.front_hit - turn * sight.result.front_hit), 1e-14);
    const glm::dmat3 difference = vergence_in_space(turned) - turn * vergence_in_space(sight) * glm::transpose(turn);
    for (int column = 0; column < 3; ++column) {
      EXPECT_LE(glm::length(difference[column]), 1e-10);
    }
  }
  EXPECT_GE(traced, kLenses / 3);
}

}  // namespace
