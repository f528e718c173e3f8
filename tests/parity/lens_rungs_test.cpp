// Every rung of the lens on the device against the double-precision reference, pixel by pixel: how far off each may be,
// that finer settings are nearer, that rims and segments stay where they are, and that nothing is ever not a number.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "lenses/surface_forms.hpp"
#include "render/gpu_tracer.hpp"
#include "render/ladder.hpp"
#include "tests/support/contact_lens.hpp"
#include "tests/support/optics_cases.hpp"
#include "tests/support/rung_frame.hpp"
#include "tests/support/worn_lens.hpp"

namespace {

using lenses::Lens;
using render::LensAccuracy;
using render::LensForm;
using support::RungErrors;
using support::RungFrame;

constexpr int kSize = 80;  // pixels
const auto kFov = tracking::FieldOfView::symmetric(50.0 * support::kDegree, 1.0);

struct Worn : support::WornLens {
  std::string name;
};

Worn worn(const std::string& name, const Lens& lens, render::Viewing viewing = render::Viewing::gaze,
          const glm::dvec3& gaze = {0.0, -0.3, -1.0}) {
  return {support::worn_lens(lens, kFov, viewing, gaze), name};
}

// Its rim and the bare scene are in the picture.
Lens small_lens() {
  Lens lens;
  lens.index = 1.6;
  lens.diameter = 0.020;
  lens.front = lenses::Torus{11.0, 8.0, 0.6, lenses::Torus::Revolve::u};
  lens.back = lenses::Sphere{12.0};
  lens.fit.pantoscopic_tilt = 9.0 * support::kDegree;
  return lens;
}

class LensRungs : public testing::Test {
 protected:
  static void SetUpTestSuite() { device_ = new support::RungDevice(); }
  static void TearDownTestSuite() { delete device_; }

  static RungErrors errors(const Worn& w, const support::ReferencePicture& reference, const LensAccuracy& lens,
                           render::Traversal traversal = render::Traversal::tile) {
    RungFrame frame(*device_, w.pair, w.view, lens, kSize, traversal);
    frame.run();
    return frame.against(reference);
  }

  // By name, of the rungs that are about the lens; `few`: one of each kind, as every lens compiles its own kernels.
  static std::map<std::string, RungErrors> all(const Worn& w, bool few = false) {
    constexpr std::array kFew{"standard",    "lens-1-iteration", "lens-grid-8",
                              "lens-double", "lens-mesh-10k",    "lens-field-64"};
    const support::ReferencePicture reference(w.pair, w.view, kSize);
    std::map<std::string, RungErrors> found;
    for (const render::Rung& rung : render::ladder()) {
      const bool is_lens = rung.subject.starts_with("lens") || rung.name == "standard";
      if (few ? std::ranges::find(kFew, rung.name) != kFew.end() : is_lens) {
        found[std::string(rung.name)] = errors(w, reference, rung.accuracy.lens);
      }
    }
    return found;
  }

  inline static support::RungDevice* device_ = nullptr;
};

TEST_F(LensRungs, AreAsNearAsTheirSettingsSayThroughAProgressive) {
  auto e = all(worn("progressive", support::progressive_lens()));
  for (const auto& [name, errors] : e) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(errors.finite);
    EXPECT_EQ(errors.status_differs, 0U);
    EXPECT_EQ(errors.through, static_cast<std::size_t>(kSize * kSize));
  }
  // A few roundings of a float's direction and of a power of some dioptres.
  for (const char* name : {"standard", "lens-3-iterations", "lens-2-iterations", "lens-1-iteration"}) {
    EXPECT_LE(e[name].direction.greatest, 2e-6) << name;
    EXPECT_LE(e[name].position.greatest, 3e-7) << name;
    EXPECT_LE(e[name].power.greatest, 1e-4) << name;
  }
  EXPECT_GE(e["lens-1-iteration"].direction.greatest, e["lens-2-iterations"].direction.greatest);
  // All that is left is the rounding of what is stored: half a unit in the last place of a direction's component and
  // of a position below 63 mm, and of the matrices that V is made from.
  EXPECT_LE(e["lens-double"].direction.greatest, 6e-8);
  EXPECT_LE(e["lens-double"].position.greatest, 4e-9);
  EXPECT_LE(e["lens-double"].power.greatest, 2e-6);
  EXPECT_LE(3.0 * e["lens-double"].power.p99, e["standard"].power.p99);
  // Bilinear between corners: a quarter for half the spacing, a sixteenth for a quarter; a margin for where the
  // squares lie. Curvature that changes within a square counts as much.
  EXPECT_LE(2.5 * e["lens-grid-16"].direction.p99, e["lens-grid-32"].direction.p99);
  EXPECT_LE(2.5 * e["lens-grid-8"].direction.p99, e["lens-grid-16"].direction.p99);
  EXPECT_LE(1.5 * e["lens-grid-16"].power.p99, e["lens-grid-32"].power.p99);
  EXPECT_LE(1.5 * e["lens-grid-8"].power.p99, e["lens-grid-16"].power.p99);
  EXPECT_LE(8.0 * e["lens-field-64"].direction.p99, e["lens-field-16"].direction.p99);
  EXPECT_LE(4.0 * e["lens-field-256"].direction.p99, e["lens-field-64"].direction.p99);
  EXPECT_LE(4.0 * e["lens-field-64"].power.p99, e["lens-field-16"].power.p99);
  // Flat facets: a tenth in direction, a third in power for ten times as many.
  EXPECT_NEAR(std::log10(e["lens-mesh-1k"].direction.p99 / e["lens-mesh-10k"].direction.p99), 1.0, 0.2);
  EXPECT_NEAR(std::log10(e["lens-mesh-10k"].direction.p99 / e["lens-mesh-100k"].direction.p99), 1.0, 0.2);
  EXPECT_NEAR(std::log10(e["lens-mesh-1k"].power.p99 / e["lens-mesh-10k"].power.p99), 0.5, 0.2);
  EXPECT_NEAR(std::log10(e["lens-mesh-10k"].power.p99 / e["lens-mesh-100k"].power.p99), 0.5, 0.2);
  EXPECT_LE(e["lens-mesh-100k"].direction.greatest, 2e-5);
  // Second derivatives from control points that are rounded to float: 1e-9 m over a patch of about a millimetre.
  EXPECT_LE(e["lens-bezier"].direction.greatest, 2e-6);
  EXPECT_LE(e["lens-bezier"].power.greatest, 5e-3);
}

TEST_F(LensRungs, KeepRimsAndSegmentsWhereTheyAre) {
  for (const Worn& w : {worn("bifocal", support::example_lens("presbyopia_bifocal")), worn("small lens", small_lens()),
                        worn("contact lens", support::contact_lens(), render::Viewing::gaze, {0.3, 0.2, -1.0}),
                        worn("scanning", support::progressive_lens(), render::Viewing::scanning)}) {
    for (const auto& [name, errors] : all(w, true)) {
      SCOPED_TRACE(w.name + ", " + name);
      EXPECT_TRUE(errors.finite);
      EXPECT_EQ(errors.status_differs_inside, 0U);
      EXPECT_GT(errors.through, static_cast<std::size_t>(kSize * kSize / 8));
      // On the rim itself, a pixel in a hundred; of a mesh, whose edge is a polygon, as many.
      EXPECT_LE(errors.status_differs, static_cast<std::size_t>(kSize * kSize / 100));
      EXPECT_LE(errors.direction.p99, 2e-3);
      // Facets err by the surface's curvature: most on a contact lens, whose front has 48 D.
      EXPECT_LE(errors.power.p99, name == "lens-mesh-10k" ? 0.4 : 0.1);
    }
  }
}

// What a device finds ray by ray is seen through the same kept rays.
TEST_F(LensRungs, AreTheSameWhateverFindsTheScene) {
  const Worn w = worn("progressive", support::progressive_lens());
  const support::ReferencePicture reference(w.pair, w.view, kSize);
  for (const LensAccuracy& lens : {LensAccuracy{.spacing = 8}, LensAccuracy{.in_double = true},
                                   LensAccuracy{.form = LensForm::mesh, .facets = 1000}}) {
    const RungErrors tile = errors(w, reference, lens);
    const RungErrors one_by_one = errors(w, reference, lens, render::Traversal::per_ray);
    EXPECT_EQ(tile.direction.greatest, one_by_one.direction.greatest);
    EXPECT_EQ(tile.power.greatest, one_by_one.power.greatest);
  }
}

// A field is traced anew as soon as the eye turns, and not before.
TEST_F(LensRungs, AFieldIsThatOfItsView) {
  const LensAccuracy field{.form = LensForm::field, .field_side = 64};
  render::Renderer renderer(device_->device, support::patch_scene({support::wall(2.0F, 4.0F, 1.0F)}));
  const Worn ahead = worn("ahead", support::progressive_lens(), render::Viewing::gaze, {0.0, 0.0, -1.0});
  const Worn down = worn("down", support::progressive_lens());
  render::FrameConfig config;
  config.width = config.height = kSize;
  config.mode = render::Mode::power;
  config.keep_wavefront = true;
  config.range = render::MapRange{-1.0, 3.0};
  config.accuracy.lens = field;
  const auto map = [&](const Worn& w) { return renderer.render(w.pair.model, {w.view}, config).views[0].wavefront; };
  const auto first = map(ahead);
  const auto again = map(ahead);
  const auto other = map(down);
  const auto back = map(ahead);
  EXPECT_EQ(first.v_vv, again.v_vv);
  EXPECT_NE(first.v_vv, other.v_vv);
  EXPECT_EQ(first.v_vv, back.v_vv);
}

// Distributed rays pass the lens in its form: in double and through patches they are the standard's but for rounding,
// through a coarse mesh they are not.
TEST_F(LensRungs, ServeDistributedRays) {
  render::Renderer renderer(device_->device, support::patch_scene({support::wall(2.0F, 0.3F, 1.0F)}));
  const Worn w = worn("progressive", support::progressive_lens());
  render::FrameConfig config;
  config.width = config.height = 48;
  config.mode = render::Mode::dof;
  config.samples = 8;
  config.keep_radiance = true;
  const auto picture = [&](const LensAccuracy& lens) {
    config.accuracy.lens = lens;
    return renderer.render(w.pair.model, {w.view}, config).views[0].radiance;
  };
  const auto mean_difference = [](const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_TRUE(std::isfinite(b[i]));
      sum += std::abs(a[i] - b[i]);
    }
    return sum / static_cast<double>(a.size());
  };
  const auto standard = picture({});
  ASSERT_GT(mean_difference(std::vector<float>(standard.size(), 0.0F), standard), 0.02);  // there is a wall to see
  // A sample is worth an eighth, and few of them pass the wall's edge within rounding.
  EXPECT_LE(mean_difference(standard, picture({.in_double = true})), 1e-4);
  EXPECT_LE(mean_difference(standard, picture({.form = LensForm::bezier})), 1e-4);
  EXPECT_LE(mean_difference(standard, picture({.iterations = 1})), 1e-4);
  EXPECT_EQ(standard, picture({.spacing = 32}));  // samples pass the exact lens
  EXPECT_GT(mean_difference(standard, picture({.form = LensForm::mesh, .facets = 8})), 1e-3);
}

// The cases that broke programs of this kind: no rung has to be right there, all have to stay finite.
TEST_F(LensRungs, StayFiniteInEveryTracedCase) {
  const auto cases = support::read_optics_cases();
  lenses::TraceBatch batch;
  for (const auto& c : cases) {
    lenses::append_request(batch, c.request);
  }
  render::GpuTracer tracer(device_->device);
  const auto expect_finite = [&](const std::vector<lenses::f32::TraceOutput>& records) {
    ASSERT_EQ(records.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      for (const auto& v : {records[i].vergence, records[i].residual, records[i].blur, records[i].back_hit,
                            records[i].front_hit, records[i].object_direction}) {
        EXPECT_TRUE(std::isfinite(v.x + v.y + v.z + v.w)) << cases[i].id;
      }
    }
  };
  for (const int steps : {1, 2, 3}) {
    SCOPED_TRACE(steps);
    expect_finite(tracer.trace(batch, steps));
  }
  const lenses::LensModel exact = batch.model;
  batch.model = lenses::as_mesh(exact, 1000);
  expect_finite(tracer.trace(batch));
  batch.model = lenses::as_bezier_patches(exact);
  expect_finite(tracer.trace(batch));
}

TEST(LensAccuracyValues, ThatNoRendererCanDoAreRefused) {
  for (const render::Rung& rung : render::ladder()) {
    EXPECT_NO_THROW(rung.accuracy.lens.validate()) << rung.name;
  }
  for (const LensAccuracy& bad :
       {LensAccuracy{.form = LensForm::mesh}, LensAccuracy{.form = LensForm::field, .field_side = 1},
        LensAccuracy{.iterations = -1}, LensAccuracy{.spacing = 0}, LensAccuracy{.spacing = 8, .in_double = true},
        LensAccuracy{.form = LensForm::bezier, .spacing = 8}}) {
    EXPECT_THROW(bad.validate(), std::invalid_argument);
  }
}

}  // namespace
