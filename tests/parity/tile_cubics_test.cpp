// Tiles whose rays are cubics between sixteen that pass the lens: as near the double-precision reference as is said of
// them, only where the lens runs smoothly, and pictures as those of every pixel's own ray.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lenses/surface_forms.hpp"
#include "render/lens_forms/tile_cubics.hpp"
#include "tests/support/contact_lens.hpp"
#include "tests/support/rung_frame.hpp"
#include "tests/support/worn_lens.hpp"

namespace {

using lenses::Lens;
using render::LensAccuracy;
using render::TileCubics;

constexpr int kSize = 192;  // pixels, not a multiple of a workgroup's squares of corners
const auto kFov = tracking::FieldOfView::symmetric(50.0 * support::kDegree, 1.0);
constexpr int kTiles = kSize / 8;
constexpr LensAccuracy kCubic{.cubics = TileCubics::always};
constexpr LensAccuracy kOwn{.cubics = TileCubics::never};

using Worn = support::WornLens;

Worn worn(const Lens& lens, const glm::dvec3& gaze = {0.0, -0.3, -1.0},
          render::Viewing viewing = render::Viewing::gaze) {
  return support::worn_lens(lens, kFov, viewing, gaze);
}

Lens toric(double diameter = 0.060) {
  Lens lens;
  lens.index = 1.6;
  lens.diameter = diameter;
  lens.front = lenses::Torus{11.0, 8.0, 0.6, lenses::Torus::Revolve::u};
  lens.back = lenses::Sphere{12.0};
  lens.fit.pantoscopic_tilt = 9.0 * support::kDegree;
  return lens;
}

// A processor does; elsewhere there is nothing to compare.
bool draws_cubics(const render::vk::Device& device) {
  return render::can_be_cubic(device.limits(), 1U);
}

class TileCubicsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { device_ = new support::RungDevice(); }
  static void TearDownTestSuite() { delete device_; }

  static std::vector<glm::vec4> wavefronts(const Worn& w, const LensAccuracy& lens) {
    support::RungFrame frame(*device_, w.pair, w.view, lens, kSize);
    frame.run();
    return frame.buffers().wavefronts.read<glm::vec4>(2 * kSize * kSize);
  }

  inline static support::RungDevice* device_ = nullptr;
};

TEST_F(TileCubicsTest, AreAsNearTheReferenceAsIsSaid) {
  ASSERT_TRUE(draws_cubics(device_->device));
  struct Case {
    const char* name;
    Worn worn;
    double least_smooth;  // of all tiles
  };
  for (const Case& c :
       {Case{"progressive", worn(support::progressive_lens()), 0.6},
        Case{"B-spline and sphere", worn(support::example_lens("presbyopia_bspline_sphere")), 0.6},
        Case{"toric, gaze to the side", worn(toric(), {0.4, 0.1, -1.0}), 0.99},
        Case{"scanning eye", worn(support::progressive_lens(), {0.0, -0.3, -1.0}, render::Viewing::scanning), 0.5},
        Case{"contact lens", worn(support::contact_lens(), {0.3, 0.2, -1.0}), 0.3}}) {
    SCOPED_TRACE(c.name);
    support::RungFrame frame(*device_, c.worn.pair, c.worn.view, kCubic, kSize);
    frame.run();
    const support::CubicPicture cubic(frame.buffers(), kSize);
    const auto seen = frame.buffers().wavefronts.read<glm::vec4>(2 * kSize * kSize);
    const support::ReferencePicture reference(c.worn.pair, c.worn.view, kSize);
    std::vector<double> direction, position, power;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const auto at = static_cast<std::size_t>(y * kSize + x);
        const auto& expected = reference.pixels[at];
        const glm::vec4& v = seen[2 * at];
        ASSERT_TRUE(std::isfinite(v.x + v.y + v.z + v.w));
        if (!cubic.is_smooth(x, y)) continue;
        ASSERT_EQ(expected.status, 0) << x << ' ' << y;
        const auto ray = cubic.at(x, y);
        direction.push_back(glm::length(ray.direction - expected.direction));
        position.push_back(glm::length(ray.origin + c.worn.view.world_from_eye.position - expected.start));
        power.push_back(std::max({std::abs(v.x - expected.vergence.x), std::abs(v.y - expected.vergence.y),
                                  std::abs(v.z - expected.vergence.z)}));
      }
    }
    EXPECT_GE(static_cast<double>(cubic.smooth_tiles()), c.least_smooth * kTiles * kTiles);
    const auto d = support::spread_of(direction), p = support::spread_of(position), v = support::spread_of(power);
    // A ten-thousandth of a pixel, and what the corners' rays are rounded by.
    EXPECT_LE(d.greatest, 1e-4 * 2.0 * std::tan(25.0 * support::kDegree) / kSize + 2e-6);
    EXPECT_LE(p.greatest, 3e-7);
    EXPECT_LE(v.greatest, 5e-3);
    EXPECT_LE(v.median, 5e-4);  // a scanning eye's tiles span a spline's whole cell
  }
}

// What no lens ever is: waves between the corners' rays, of a period below theirs and above.
TEST_F(TileCubicsTest, LeaveUnevenSurfacesToEachPixel) {
  ASSERT_TRUE(draws_cubics(device_->device));
  std::mt19937 random(20261122);
  std::uniform_real_distribution<double> height(-2e-7, 2e-7);  // m
  Lens lens = support::progressive_lens();
  auto& front = std::get<lenses::BsplineHeightField>(lens.front);
  for (double& z : front.control_z) z += height(random);
  const Worn w = worn(lens);
  support::RungFrame frame(*device_, w.pair, w.view, kCubic, kSize);
  frame.run();
  const support::CubicPicture cubic(frame.buffers(), kSize);
  const auto seen = frame.buffers().wavefronts.read<glm::vec4>(2 * kSize * kSize);
  const auto own = wavefronts(w, kOwn);
  std::size_t rough = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const auto at = 2 * static_cast<std::size_t>(y * kSize + x);
      rough += cubic.is_smooth(x, y) ? 0 : 1;
      if (cubic.is_smooth(x, y)) {
        EXPECT_LE(glm::length(seen[at] - own[at]), 1e-2F);
      } else {
        EXPECT_EQ(seen[at], own[at]);
      }
    }
  }
  EXPECT_GT(rough, static_cast<std::size_t>(kSize * kSize / 4));
}

// A rim's tiles are traced pixel by pixel, so that it stays where it is to the bit.
TEST_F(TileCubicsTest, KeepRimsWhereTheyAre) {
  for (const Worn& w : {worn(toric(0.020)), worn(toric(0.026), {0.2, 0.1, -1.0}, render::Viewing::scanning)}) {
    const auto cubic = wavefronts(w, kCubic);
    const auto own = wavefronts(w, kOwn);
    std::size_t beside = 0;
    for (std::size_t at = 1; at < own.size(); at += 2) {
      EXPECT_EQ(cubic[at].z, own[at].z);  // the status
      beside += own[at].z != 0.0F ? 1 : 0;
    }
    EXPECT_GT(beside, own.size() / 100);
  }
}

TEST_F(TileCubicsTest, AreNotForSegmentsNorForFiguresNorForCoarsePictures) {
  EXPECT_EQ(wavefronts(worn(support::example_lens("presbyopia_bifocal")), kCubic),
            wavefronts(worn(support::example_lens("presbyopia_bifocal")), kOwn));
  render::FrameConfig config;
  config.width = config.height = kSize;
  config.mode = render::Mode::adof;
  const std::vector views{worn(support::progressive_lens()).view};
  EXPECT_TRUE(render::may_be_cubic(config, views, render::Traversal::tile));
  EXPECT_FALSE(render::may_be_cubic(config, views, render::Traversal::per_ray));
  config.keep_wavefront = true;
  EXPECT_FALSE(render::may_be_cubic(config, views, render::Traversal::tile));
  config.keep_wavefront = false;
  config.mode = render::Mode::power;
  EXPECT_FALSE(render::may_be_cubic(config, views, render::Traversal::tile));
  config.mode = render::Mode::pinhole;
  EXPECT_TRUE(render::may_be_cubic(config, views, render::Traversal::tile));
  config.width = config.height = 96;
  EXPECT_FALSE(render::may_be_cubic(config, views, render::Traversal::tile));
  config.width = config.height = kSize;
  config.accuracy.lens = kOwn;
  EXPECT_FALSE(render::may_be_cubic(config, views, render::Traversal::tile));
}

// Two eyes of which one looks through nothing, before a wall with an edge.
TEST_F(TileCubicsTest, ShowThePictureOfEveryPixelsRay) {
  const auto scene = support::patch_scene({support::wall(2.0F, 0.3F, 1.0F), support::wall(4.0F, 4.0F, 0.4F)});
  render::Renderer renderer(device_->device, scene, {.traversal = render::Traversal::tile});
  Worn w = worn(support::progressive_lens(), {0.0, -0.1, -1.0});
  render::ViewSetup bare = w.view;
  w.pair.model.lens.push_back(w.pair.model.lens[w.view.lens]);
  w.pair.model.lens.back().glass.w = 0.0;
  bare.lens = w.pair.model.lens.size() - 1;
  render::FrameConfig config;
  config.width = kSize;
  config.height = kSize - 20;  // tiles that are cut off
  config.keep_radiance = true;
  for (const auto mode : {render::Mode::adof, render::Mode::pinhole}) {
    const auto picture = [&](const LensAccuracy& lens) {
      config.mode = mode;
      config.accuracy.lens = lens;
      return renderer.render(w.pair.model, {w.view, bare}, config).views;
    };
    config.mode = mode;
    config.accuracy.lens = {};
    renderer.prepare(w.pair.model, {w.view, bare}, config);
    const std::size_t kernels = renderer.kernels_made();
    const auto cubic = picture({});
    EXPECT_EQ(renderer.kernels_made(), kernels);
    const auto own = picture(kOwn);
    for (std::size_t view = 0; view < 2; ++view) {
      std::size_t apart = 0;
      for (std::size_t i = 0; i < own[view].radiance.size(); ++i) {
        ASSERT_TRUE(std::isfinite(cubic[view].radiance[i]));
        apart += std::abs(cubic[view].radiance[i] - own[view].radiance[i]) > 2e-3F ? 1 : 0;
      }
      // Rays that pass an edge within a ten-thousandth of a pixel may fall on its other side.
      EXPECT_LE(apart, own[view].radiance.size() / 10000) << view;
    }
  }
}

}  // namespace
