// What approximate defocus must do at edges, in focus and in hard cases, against geometry and against distributed rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/image/shown_error.hpp"
#include "render/ladder.hpp"
#include "render/vk/device.hpp"
#include "tests/support/defocus_scene.hpp"

namespace {

using render::FrameConfig;
using render::Mode;
using render::RenderedView;
using support::WornPair;

constexpr int kSize = 96;              // px a side
constexpr double kPixel = 1.0 / 2000;  // rad
constexpr double kDistance = 2.0;      // m, of the wall

render::vk::Device& device() {
  static render::vk::Device device;
  return device;
}

// The bare right eye at the origin, which sees a wall at kDistance with a blur of `radius_px`: myopic by what that
// takes.
render::ViewSetup eye_with_blur(const WornPair& pair, double radius_px, double pixels_aside = 0.0) {
  const double half = 0.5 * kSize * kPixel, aside = pixels_aside * kPixel;
  auto setup =
      support::view_along(pair, 0, render::Viewing::fixed, {0, 0, -1}, {half - aside, half + aside, half, half});
  setup.world_from_eye = {};
  const double residual = 2.0 * radius_px * kPixel / setup.eye.pupil.x;
  setup.eye.excess = glm::dvec4(residual + 1.0 / kDistance, 0.0, residual + 1.0 / kDistance, 0.0);
  setup.accommodation = 0.0;
  return setup;
}

RenderedView render_with(render::Renderer& renderer, const WornPair& pair, const render::ViewSetup& setup,
                         FrameConfig config) {
  config.width = config.height = kSize;
  config.keep_radiance = true;
  return renderer.render(pair.model, {setup}, config).views.at(0);
}

WornPair bare_pair() {
  return support::wear(lenses::Wearer{}, nullptr, tracking::Pose{});
}

float green(const RenderedView& view, int x, int y) {
  return view.radiance[3 * static_cast<std::size_t>(y * kSize + x) + 1];
}

// Upright bars, half as wide as their period, white on black.
render::Scene bars(double period_px) {
  render::Scene scene = support::dark_scene();
  const auto white = support::add_material(scene, support::unlit(glm::vec4(1.0F)));
  const auto black = support::add_material(scene, support::unlit({0.0F, 0.0F, 0.0F, 1.0F}));
  const double period = period_px * kPixel * kDistance;
  const auto behind = static_cast<float>(1.0001 * kDistance);
  support::add_wall(scene, black, 0.0F, 0.0F, behind, 0.2F);
  const int count = static_cast<int>(0.1 / period);
  for (int i = -count; i <= count; ++i) {
    support::add_square(scene, white, glm::vec3((i - 0.25) * period, -0.2, -kDistance),
                        glm::vec3(0.5 * period, 0.0, 0.0), glm::vec3(0.0, 0.4, 0.0));
  }
  return scene;
}

// Of the bars' first harmonic, signed: below zero where dark and light have changed places.
double contrast(const RenderedView& view, double period_px) {
  const int width = static_cast<int>(std::floor(0.6 * kSize / period_px) * period_px + 0.5);  // whole periods
  const int first = (kSize - width) / 2;
  double sum = 0.0, harmonic = 0.0;
  for (int x = first; x < first + width; ++x) {
    const double light = green(view, x, kSize / 2);
    sum += light;
    harmonic += light * std::cos(2.0 * std::numbers::pi * (x + 0.5 - 0.5 * kSize) / period_px);
  }
  return 2.0 * harmonic / sum;
}

// A disc of radius r passes nothing of the frequency 0.61 / r (the first zero of J1), turns contrast over beyond it,
// and both ways to blur must agree on all of it.
TEST(Adof, KeepsTheContrastOfLettersBars) {
  const auto pair = bare_pair();
  for (const double radius_px : {4.0, 7.0, 9.0}) {
    for (const double of_first_zero : {0.5, 1.0, 1.5}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius_px << " px, " << of_first_zero << " of the first zero");
      const double period_px = radius_px / 0.6098 / of_first_zero;
      render::Renderer renderer(device(), bars(period_px), {.traversal = render::Traversal::per_ray});
      const auto setup = eye_with_blur(pair, radius_px);
      FrameConfig config;
      const double adof = contrast(render_with(renderer, pair, setup, config), period_px);
      config.mode = Mode::dof;
      config.samples = 64;
      const double dof = contrast(render_with(renderer, pair, setup, config), period_px);
      EXPECT_NEAR(adof, dof, 0.05);
    }
  }
}

// A picture in which nothing is out of focus by as much as the threshold.
TEST(Adof, InFocusEqualsPinholeBitForBit) {
  render::Renderer renderer(device(), bars(5.3));
  const auto pair = bare_pair();
  FrameConfig config;
  const auto setup = eye_with_blur(pair, 0.4);
  const auto adof = render_with(renderer, pair, setup, config);
  config.mode = Mode::pinhole;
  const auto pinhole = render_with(renderer, pair, setup, config);
  EXPECT_EQ(adof.radiance, pinhole.radiance);
  EXPECT_EQ(adof.display.rgb, pinhole.display.rgb);
}

constexpr double kNear = 0.25;  // m, of what stands before the wall

// The left half of the view, `light` bright, before a wall.
render::Scene half_covered(double at, float light, float wall) {
  render::Scene scene = support::dark_scene();
  const auto near = support::add_material(scene, support::unlit({light, light, light, 1.0F}));
  const auto far = support::add_material(scene, support::unlit({wall, wall, wall, 1.0F}));
  support::add_wall(scene, far, 0.0F, 0.0F, static_cast<float>(kDistance), 0.5F);
  support::add_square(scene, near, glm::vec3(-0.5, -0.5, -at), glm::vec3(0.5, 0.0, 0.0), glm::vec3(0.0, 1.0, 0.0));
  return scene;
}

// The eye focused on the wall: light that stands before it spreads past its edge as the pupil's part that it covers.
TEST(Adof, BlurredForegroundSpreadsPastItsEdge) {
  render::Renderer renderer(device(), half_covered(kNear, 1.0F, 0.0F));
  const auto pair = bare_pair();
  const auto setup = eye_with_blur(pair, 0.0);
  const double radius_px = 0.5 * setup.eye.pupil.x * (1.0 / kNear - 1.0 / kDistance) / kPixel;
  const auto view = render_with(renderer, pair, setup, {});
  for (int x = 0; x < kSize; ++x) {
    const double past = std::clamp((x + 0.5 - 0.5 * kSize) / radius_px, -1.0, 1.0);
    const double covered = (std::acos(past) - past * std::sqrt(1.0 - past * past)) / std::numbers::pi;
    EXPECT_NEAR(green(view, x, kSize / 2), covered, 0.03) << x;
  }
}

// The eye focused on what stands before a blurred wall: its light, however bright, stays where it is.
TEST(Adof, SharpForegroundDoesNotBleed) {
  render::Renderer renderer(device(), half_covered(kNear, 100.0F, 0.2F));
  const auto pair = bare_pair();
  auto setup = eye_with_blur(pair, 0.0);
  setup.eye.excess = glm::dvec4(1.0 / kNear, 0.0, 1.0 / kNear, 0.0);
  const auto view = render_with(renderer, pair, setup, {});
  for (int x = 0; x < kSize / 2 - 1; ++x) EXPECT_FLOAT_EQ(green(view, x, kSize / 2), 100.0F) << x;
  for (int x = kSize / 2 + 1; x < kSize; ++x) EXPECT_NEAR(green(view, x, kSize / 2), 0.2F, 1e-3F) << x;
}

// Nor does a bright wall in focus bleed into what is blurred in front of it, but for what its blur lets through.
TEST(Adof, SharpBackgroundDoesNotBleed) {
  render::Renderer renderer(device(), half_covered(kNear, 0.2F, 50.0F));
  const auto pair = bare_pair();
  const auto setup = eye_with_blur(pair, 0.0);
  const double radius_px = 0.5 * setup.eye.pupil.x * (1.0 / kNear - 1.0 / kDistance) / kPixel;
  const auto view = render_with(renderer, pair, setup, {});
  for (int x = 0; x < kSize / 2 - static_cast<int>(radius_px) - 2; ++x) {
    EXPECT_NEAR(green(view, x, kSize / 2), 0.2F, 1e-3F) << x;
  }
}

// A head that turns by a pixel sees the same picture, a pixel aside: blur has no grain that stays on the screen.
TEST(Adof, IsSteadyAsTheHeadTurns) {
  render::Renderer renderer(device(), support::layered_scene());
  const auto pair = bare_pair();
  for (const double radius_px : {2.5, 6.0, 14.0}) {
    const auto still = render_with(renderer, pair, eye_with_blur(pair, radius_px), {});
    const auto turned = render_with(renderer, pair, eye_with_blur(pair, radius_px, 1.0), {});
    std::vector<float> a, b;
    for (int y = 20; y < kSize - 20; ++y) {
      for (int x = 20; x < kSize - 20; ++x) {
        a.push_back(green(still, x + 1, y));
        b.push_back(green(turned, x, y));
      }
    }
    const double psnr_db = render::compare_shown(a, b, 1.0, {}, 1).psnr_db;
    // Edge rays fall elsewhere, which a narrow blur shows most, and squares of pixels hold others.
    EXPECT_GE(psnr_db, 38.0);
  }
}

struct HardView {
  double excess = 0.0;  // D
  double half_tangent = 0.5;
  int width = 61, height = 47;  // no whole tiles
  const char* spectacles = nullptr;
};

// Every rung of the blur, with lamps as bright as a half float holds, rims, sky, and blurs of many times the picture.
TEST(Adof, IsFiniteAtEveryRungInHardCases) {
  render::Scene scene = support::lamp_scene();
  const auto sun = support::add_material(scene, support::unlit(glm::vec4(60000.0F, 60000.0F, 60000.0F, 1.0F)));
  support::add_ball(scene, sun, {0.02F, 0.01F, -0.3F}, 0.002F, 6);
  render::Renderer renderer(device(), scene, {.traversal = render::Traversal::per_ray});
  const HardView hard[] = {{25.0, 0.02},
                           {-25.0, 0.5, 8, 8},
                           {3.0, 1.2, 61, 47, VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json"},
                           {1.0, 0.1, 200, 3}};
  for (const HardView& h : hard) {
    std::optional<lenses::Spectacles> spectacles;
    if (h.spectacles != nullptr) spectacles = lenses::read_spectacles(h.spectacles);
    const auto pair = support::wear(lenses::Wearer{}, spectacles ? &*spectacles : nullptr, *scene.start_pose());
    auto setup = support::view_along(pair, 0, render::Viewing::fixed, {0, 0, -1},
                                     {h.half_tangent, h.half_tangent, h.half_tangent, h.half_tangent});
    setup.eye.excess = glm::dvec4(h.excess, 0.3 * h.excess, -0.5 * h.excess, 0.0);
    setup.accommodation = 0.0;
    for (const render::Rung& rung : render::ladder()) {
      if (!rung.subject.starts_with("blur") && rung.name != "standard") continue;
      SCOPED_TRACE(testing::Message() << rung.name << ", " << h.excess << " D, " << h.width << " x " << h.height);
      FrameConfig config;
      config.width = h.width;
      config.height = h.height;
      config.keep_radiance = true;
      config.accuracy = rung.accuracy;
      const auto view = renderer.render(pair.model, {setup}, config).views.at(0);
      EXPECT_TRUE(std::ranges::all_of(
          view.radiance, [](float light) { return std::isfinite(light) && light >= 0.0F && light <= 60100.0F; }));
    }
  }
}

}  // namespace
