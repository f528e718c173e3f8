// How far distributed rays are from the truth after so many samples: at the rate that their pattern promises, and as
// far as they say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "render/shaders/sample_pattern.h"
#include "render/vk/device.hpp"
#include "tests/support/lit_scene.hpp"

namespace {

using render::FrameConfig;
using render::RenderedFrame;

constexpr int kSize = 96;              // pixels
constexpr double kHalfTangent = 0.02;  // a pixel is 0.42 mrad
constexpr double kBlurPixels = 8.0;    // radius of the pupil's image

// Ahead of the eye at 2 m a wall whose right half gives off light; to the left, a turn of the head away, a matte wall
// under a lamp, without any edge; to the right the same in print.
render::Scene walls() {
  render::Scene scene = support::dark_scene();
  const auto bright = support::add_material(scene, support::unlit(glm::vec4(1.0F)));
  support::add_square(scene, bright, {0, -1, -2}, {1, 0, 0}, {0, 2, 0});
  const auto matte = support::add_material(scene, support::matte(glm::vec3(0.8F)));
  support::add_square(scene, matte, {-2, -1, 1}, {0, 0, -2}, {0, 2, 0});
  render::Light lamp;
  lamp.type = render::Light::Type::point;
  lamp.position = {-1.97F, 0.01F, 0.02F};  // so near that its light fades within the picture
  lamp.colour = glm::vec3(0.01F);
  scene.lights.push_back(lamp);
  auto print = support::unlit(glm::vec4(1.0F));
  print.base_colour_texture.index = support::add_texture(scene, 256, 256, [](std::uint32_t x, std::uint32_t y) {
    return glm::uvec4(glm::uvec3(render::gpu::mixed(y * 256 + x) % 3 == 0 ? 20 : 230), 255);
  });
  const auto printed = support::add_material(scene, print);
  support::add_square(scene, printed, {2, -0.2F, -0.2F}, {0, 0, 0.4F}, {0, 0.4F, 0});
  return scene;
}

enum class Wall { edge, smooth, print };

class DofError : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    device_ = new render::vk::Device();
    renderer_ = new render::Renderer(*device_, walls());
  }
  static void TearDownTestSuite() {
    delete renderer_;
    delete device_;
  }

  static FrameConfig config(int samples, std::uint32_t seed = 0) {
    FrameConfig config;
    config.width = config.height = kSize;
    config.mode = render::Mode::dof;
    config.samples = samples;
    config.seed = seed;
    config.bare = true;
    config.keep_radiance = true;
    return config;
  }

  static RenderedFrame drawn(Wall wall, const FrameConfig& config) {
    const support::WornPair pair = support::wear(lenses::Wearer{}, nullptr, tracking::Pose{});
    render::ViewSetup view = support::view_along(pair, 0, render::Viewing::fixed, {0, 0, -1},
                                                 {kHalfTangent, kHalfTangent, kHalfTangent, kHalfTangent});
    const double turn = wall == Wall::edge ? 0.0 : wall == Wall::smooth ? -0.5 : 0.5;
    view.world_from_eye = tracking::Pose{tracking::orientation_from_yaw_pitch(turn * std::numbers::pi, 0.0), {}};
    view.eye.pupil.x = 0.004;
    const double residual = kBlurPixels * 2.0 * kHalfTangent / kSize / 0.002;
    view.eye.excess = glm::dvec4(residual + 0.5, 0.0, residual + 0.5, 0.0);
    view.accommodation = 0.0;
    return renderer_->render(pair.model, {view}, config);
  }

  inline static render::vk::Device* device_ = nullptr;
  inline static render::Renderer* renderer_ = nullptr;
};

// The part of a disc of this radius that lies beyond a line at `x`, integrated over x: from 0 far left of the disc.
double disc_beyond(double x, double radius) {
  const double u = std::clamp(x / radius, -1.0, 1.0);
  const double root = std::sqrt(1.0 - u * u);
  const double inside = u * (0.5 + std::asin(u) / std::numbers::pi) + root / std::numbers::pi -
                        root * root * root / (3.0 * std::numbers::pi);
  return radius * inside + std::max(x - radius, 0.0);
}

double edge_error(const RenderedFrame& frame) {
  double sum = 0.0;
  for (int i = 0; i < kSize * kSize; ++i) {
    const double x = i % kSize - 0.5 * kSize;
    const double truth = disc_beyond(x + 1.0, kBlurPixels) - disc_beyond(x, kBlurPixels);  // over the pixel's width
    const double error = frame.views[0].radiance[3 * static_cast<std::size_t>(i)] - truth;
    sum += error * error;
  }
  return std::sqrt(sum / (kSize * kSize));
}

double rms_difference(const RenderedFrame& a, const RenderedFrame& b) {
  double sum = 0.0;
  for (std::size_t i = 1; i < a.views[0].radiance.size(); i += 3) {
    const double d = a.views[0].radiance[i] - b.views[0].radiance[i];
    sum += d * d;
  }
  return std::sqrt(3.0 * sum / static_cast<double>(a.views[0].radiance.size()));
}

// Independent samples would err by N^-1/2, a quarter after 16 times as many. In one box of a net a sample is
// independent of the others; those boxes that an edge passes err alone, N^(3/4) of N in the four dimensions of pixel
// and pupil: N^-5/8, which is 5.7 for 16. Without an edge each box errs by no more than its size: better than N^-1,
// or 16.
TEST_F(DofError, FallsAsAScrambledNetDoes) {
  EXPECT_GE(edge_error(drawn(Wall::edge, config(32))) / edge_error(drawn(Wall::edge, config(512))), 5.7);
  EXPECT_GE(drawn(Wall::smooth, config(32)).error_estimate / drawn(Wall::smooth, config(512)).error_estimate, 16.0);
}

// The light that an edge leaves is known in closed form. Some 1700 of the pixels count, each estimating its own error
// from one difference: 2 % of scatter of the estimate, and as much of the error itself.
TEST_F(DofError, IsAsLargeAsItSays) {
  for (const int samples : {32, 64, 128}) {
    for (const std::uint32_t seed : {0U, 1U, 2U}) {
      const auto frame = drawn(Wall::edge, config(samples, seed));
      EXPECT_NEAR(frame.error_estimate / edge_error(frame), 1.0, 0.1) << samples << " samples, seed " << seed;
    }
  }
  // Print against itself with 32 times the samples.
  const auto rough = drawn(Wall::print, config(32)), fine = drawn(Wall::print, config(1024, 9));
  EXPECT_NEAR(rough.error_estimate / rms_difference(rough, fine), 1.0, 0.1);
}

TEST_F(DofError, TargetStopsAsSoonAsItIsReached) {
  FrameConfig until = config(4096);
  until.target_error = 0.004;
  const auto frame = drawn(Wall::edge, until);
  EXPECT_LE(frame.error_estimate, 0.004);
  EXPECT_LE(edge_error(frame), 1.1 * 0.004);
  EXPECT_LT(frame.samples, 256);
  ASSERT_GT(frame.samples, render::gpu::kEvenSamples);
  EXPECT_GT(drawn(Wall::edge, config(frame.samples - render::gpu::kEvenSamples)).error_estimate, 0.004);
  until.samples = 48;  // and no further than allowed
  EXPECT_EQ(drawn(Wall::edge, until).samples, 48);
}

// A picture that stands still becomes better from frame to frame.
TEST_F(DofError, FramesGoOnWithTheSamplesOfTheOneBefore) {
  const auto at_once = drawn(Wall::print, config(21));
  FrameConfig step = config(1);
  RenderedFrame frame;
  for (const int samples : {1, 8, 21}) {
    step.samples = samples;
    frame = drawn(Wall::print, step);
    EXPECT_EQ(frame.samples, samples);
    step.samples_before = samples;
  }
  EXPECT_EQ(frame.views[0].radiance, at_once.views[0].radiance);
  EXPECT_EQ(frame.views[0].display.rgb, at_once.views[0].display.rgb);
  EXPECT_EQ(frame.error_estimate, at_once.error_estimate);
  step.samples = 40;
  step.samples_before = 20;
  EXPECT_THROW((void)drawn(Wall::print, step), std::invalid_argument);
}

}  // namespace
