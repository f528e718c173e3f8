// A lens as triangle meshes and as Bezier patches beside the same lens exactly, on the CPU: the orders at which a
// mesh's errors fall, patches that are the surface itself, no form that leaves the rails in the hard cases, and how
// many steps Newton's method takes.
#include "lenses/surface_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lenses/lens_io/lens_io.hpp"
#include "render/lens_forms/iteration_histogram.hpp"
#include "tests/support/optics_cases.hpp"
#include "tests/support/random_lens.hpp"
#include "tests/support/worn_views.hpp"

namespace {

namespace f64 = lenses::f64;
using lenses::LensModel;

struct Errors {
  double position = 0.0, direction = 0.0, power = 0.0;  // rms: m, rad, D
  double worst_position = 0.0, worst_direction = 0.0, worst_power = 0.0;
  std::size_t rays = 0, status_differs = 0;
};

f64::SightLine traced(const LensModel& model, const glm::dvec3& direction) {
  f64::EyeData eye{};
  eye.pupil = glm::dvec4(0.0035, 0.01045, -1.0, 0.0);
  return f64::trace_sight_line(f64::Table{model.table}, model.lens.front(), eye, glm::dmat3(1.0), direction,
                               glm::dvec2(0.0), glm::dvec2(0.0));
}

double power_of(const LensModel& model, const f64::SightLine& line) {
  int status = line.status;
  const glm::dvec3 v = f64::sight_line_vergence(f64::sight_line_transfer(model.lens.front(), line), 0.0, status);
  return 0.5 * (v.x + v.z);
}

// Rays within 25 degrees, well inside the lens.
Errors compare(const LensModel& exact, const LensModel& form) {
  constexpr int kSide = 24;
  Errors e;
  for (int k = 0; k < kSide * kSide; ++k) {
    const glm::dvec2 at = (glm::dvec2(k % kSide, k / kSide) + 0.5) / (0.5 * kSide) - 1.0;
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.45 * at, -1.0));
    const auto wanted = traced(exact, direction);
    const auto got = traced(form, direction);
    if (wanted.status != got.status) {
      ++e.status_differs;
      continue;
    }
    if (wanted.status != f64::kStatusOk) {
      continue;
    }
    ++e.rays;
    const double position = glm::length(got.start - wanted.start);
    const double angle = glm::length(got.direction_object - wanted.direction_object);
    const double power = std::abs(power_of(form, got) - power_of(exact, wanted));
    e.position += position * position;
    e.direction += angle * angle;
    e.power += power * power;
    e.worst_position = std::max(e.worst_position, position);
    e.worst_direction = std::max(e.worst_direction, angle);
    e.worst_power = std::max(e.worst_power, power);
  }
  const auto rms = [&](double sum) { return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(e.rays, 1))); };
  e.position = rms(e.position);
  e.direction = rms(e.direction);
  e.power = rms(e.power);
  return e;
}

LensModel model_of(const lenses::Lens& lens) {
  LensModel model;
  lenses::append_lens(model, &lens, lenses::Side::right, 0.00305);
  return model;
}

// In squares of side h a facet is off by h^2, its interpolated gradient too, its curvature by h: sixteen times the
// facets are a quarter of h.
TEST(LensMesh, ErrorsFallAsTheOrderOfFlatFacetsSays) {
  support::Random random(21);
  for (std::size_t kind = 1; kind < support::kPlacedKind + 1; ++kind) {
    SCOPED_TRACE(support::kSurfaceNames[kind]);
    const LensModel exact = model_of(support::ordinary_lens(random, kind, 1));
    const Errors coarse = compare(exact, lenses::as_mesh(exact, 4000));
    const Errors fine = compare(exact, lenses::as_mesh(exact, 64000));
    ASSERT_GT(fine.rays, 300U);
    EXPECT_EQ(coarse.status_differs, 0U);
    EXPECT_EQ(fine.status_differs, 0U);
    // Half as much again either way: where in a facet the rays fall is chance.
    EXPECT_NEAR(std::log2(coarse.direction / fine.direction), 4.0, 0.6);
    EXPECT_NEAR(std::log2(coarse.position / fine.position), 4.0, 0.6);
    EXPECT_NEAR(std::log2(coarse.power / fine.power), 2.0, 0.6);
    EXPECT_LT(fine.direction, 1e-4);
  }
}

// The patches are the spline in another basis. Newton's method ends below 3e-5 of a patch, a tenth of a nanometre.
TEST(LensPatches, AreTheSplineItself) {
  support::Random random(22);
  for (const std::size_t kind : {4U, 5U, 6U, 7U}) {
    for (int repeat = 0; repeat < 4; ++repeat) {
      SCOPED_TRACE(support::kSurfaceNames[kind]);
      const LensModel exact = model_of(support::ordinary_lens(random, kind, 5));
      const LensModel patches = lenses::as_bezier_patches(exact);
      ASSERT_EQ(patches.lens.front().back.kind.x, f64::kBezier);
      const Errors e = compare(exact, patches);
      ASSERT_GT(e.rays, 300U);
      EXPECT_LE(e.status_differs, kind == support::kSegmentedKind ? 2U : 0U);  // at the segment's edge
      EXPECT_LE(e.worst_position, 1e-9);
      EXPECT_LE(e.worst_direction, 1e-8);
      EXPECT_LE(e.worst_power, 1e-5);
    }
  }
}

TEST(LensPatches, LeaveWhatHasAClosedFormAlone) {
  support::Random random(23);
  const LensModel exact = model_of(support::ordinary_lens(random, 3, 1));
  const LensModel patches = lenses::as_bezier_patches(exact);
  EXPECT_EQ(patches.table, exact.table);
  EXPECT_EQ(patches.lens.front().front.kind.x, f64::kTorus);
}

// The paper's three steps, from the middle of each patch (section 4.1).
TEST(LensPatches, ThreeStepsAreEnoughFromTheMiddleOfAPatch) {
  const auto spectacles = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json");
  const auto pair = support::wear(lenses::Wearer{}, &spectacles, tracking::Pose{});
  const auto view = support::view_along(pair, 0, render::Viewing::gaze, {0.0, -0.3, -1.0},
                                        tracking::FieldOfView::symmetric(60.0 * support::kDegree, 1.0));
  for (const render::Precision precision : {render::Precision::single, render::Precision::twofold}) {
    const auto steps = render::iteration_histogram(view, lenses::as_bezier_patches(pair.model), 48, 48, precision);
    EXPECT_EQ(steps.iterated(), 48U * 48U);  // the front alone: the back is a sphere
    EXPECT_EQ(steps.settled_within(3), 1.0);
  }
}

template <class Output>
bool finite(const Output& record) {
  const auto sound = [](const auto& v) { return std::isfinite(v.x + v.y + v.z + v.w); };
  return sound(record.vergence) && sound(record.residual) && sound(record.blur) && sound(record.back_hit) &&
         sound(record.front_hit) && sound(record.object_direction);
}

// No form has to be right where a surface ends or rays graze it, but each has to stay finite.
TEST(LensForms, StayFiniteInEveryTracedCase) {
  const auto cases = support::read_optics_cases();
  lenses::TraceBatch batch;
  for (const auto& c : cases) {
    lenses::append_request(batch, c.request);
  }
  const LensModel exact = batch.model;
  for (const auto& form : {lenses::as_mesh(exact, 8), lenses::as_mesh(exact, 1000), lenses::as_bezier_patches(exact)}) {
    batch.model = form;
    const auto reference = lenses::trace_reference(batch);
    const auto single = lenses::trace_reference_float(batch);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      EXPECT_TRUE(finite(reference[i])) << cases[i].id;
      EXPECT_TRUE(finite(single[i])) << cases[i].id;
    }
  }
}

// The paper's claim of three, for chief rays on the height field from its base sphere.
TEST(SurfaceIterations, ThreeAreEnoughThroughAProgressive) {
  const auto spectacles = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json");
  const auto pair = support::wear(lenses::Wearer{}, &spectacles, tracking::Pose{});
  render::IterationHistogram all;
  for (const glm::dvec3 gaze : {glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.3, -0.5, -1.0)}) {
    const auto view = support::view_along(pair, 0, render::Viewing::gaze, gaze,
                                          tracking::FieldOfView::symmetric(60.0 * support::kDegree, 1.0));
    all += render::iteration_histogram(view, pair.model, 48, 48);
  }
  EXPECT_GT(all.iterated(), 48U * 48U);
  EXPECT_EQ(all.closed_form, all.iterated());  // a spline in front of a sphere
  EXPECT_EQ(all.searched, 0U);
  EXPECT_EQ(all.settled_within(3), 1.0);
  EXPECT_LT(all.settled_within(0), 0.1);
}

TEST(SurfaceIterations, NothingIteratesWithoutALens) {
  const auto pair = support::wear(lenses::Wearer{}, nullptr, tracking::Pose{});
  const auto view = support::view_along(pair, 0, render::Viewing::fixed, {0.0, 0.0, -1.0},
                                        tracking::FieldOfView::symmetric(60.0 * support::kDegree, 1.0));
  const auto none = render::iteration_histogram(view, pair.model, 8, 8);
  EXPECT_EQ(none.iterated() + none.closed_form, 0U);
  EXPECT_EQ(none.settled_within(0), 1.0);
}

}  // namespace
