// Pixels that a headset hides are left out, and all others are to the bit what they are without a mask.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "render/guard_band.hpp"
#include "render/live_frame.hpp"
#include "tests/support/lit_scene.hpp"

namespace {

using render::LiveConfig;
using render::Mode;
using render::Traversal;
using render::Viewing;
using support::WornPair;
using tracking::FieldOfView;
using tracking::HiddenArea;
using tracking::PixelMask;

constexpr int kWidth = 250, kHeight = 230;  // no whole number of tiles
// Of canted displays: wider towards the temple.
constexpr std::array kFields{FieldOfView{0.18, 0.28, 0.22, 0.2}, FieldOfView{0.28, 0.18, 0.22, 0.2}};

// All but a disc, as lenses leave it, with parts of its own hidden (a nose).
HiddenArea around_disc(const FieldOfView& fov, double radius, bool nose = true) {
  const glm::dvec2 centre(0.5 * (fov.tan_right - fov.tan_left), 0.5 * (fov.tan_up - fov.tan_down));
  constexpr int kParts = 24;
  HiddenArea area;
  const auto at = [&](int i, double r) {
    return centre + r * glm::dvec2(std::cos(2.0 * M_PI * i / kParts), std::sin(2.0 * M_PI * i / kParts));
  };
  for (int i = 0; i < kParts; ++i) {
    area.triangles.push_back({at(i, radius), at(i, 3.0), at(i + 1, 3.0)});
    area.triangles.push_back({at(i, radius), at(i + 1, 3.0), at(i + 1, radius)});
  }
  if (nose) {
    area.triangles.push_back({centre + glm::dvec2(-0.1, -0.3), centre + glm::dvec2(0.1, -0.3), centre});
  }
  return area;
}

// Print on walls at several depths, so that blurs of all widths meet, lit by one light.
render::Scene room() {
  render::Scene scene = support::dark_scene();
  scene.environment = {glm::vec3(0.3F, 0.4F, 0.6F), glm::vec3(0.2F), glm::vec3(0.1F)};
  const auto print = [&](std::uint32_t across, std::uint32_t down) {
    render::Material material = support::unlit(glm::vec4(1.0F));
    material.base_colour_texture.index = support::add_texture(scene, 64, 64, [=](std::uint32_t x, std::uint32_t y) {
      const std::uint32_t v = (x / across + y / down) % 2 == 0 ? 235 : 30;
      return glm::uvec4(v, 255 - v / 2, 40 + v / 3, 255);
    });
    return support::add_material(scene, material);
  };
  support::add_wall(scene, print(3, 5), 0.0F, 0.0F, 2.5F, 0.5F);
  support::add_wall(scene, print(4, 4), -0.05F, 0.05F, 0.8F, 0.06F);
  support::add_wall(scene, print(9, 2), 0.05F, -0.05F, 0.6F, 0.05F);
  support::add_ball(scene, support::add_material(scene, support::unlit({0.9F, 0.7F, 0.2F, 1.0F})),
                    glm::vec3(0.15F, 0.12F, -1.0F), 0.05F, 8);
  return scene;
}

struct Setting {
  std::string name;
  Mode mode = Mode::adof;
  bool spectacles = true;
  bool bare = false;
  Traversal traversal = Traversal::tile;
  render::Accuracy accuracy = {};
};

class MaskedFrame : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    device_ = new render::vk::Device();
    scene_ = new render::Scene(room());
  }
  static void TearDownTestSuite() {
    delete device_;
    delete scene_;
  }

  // A 70-year-old, who accommodates to nothing near.
  static WornPair worn(bool spectacles) {
    static const lenses::Spectacles pair =
        lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json");
    lenses::Wearer wearer;
    wearer.age = 70.0;
    for (lenses::Eye& eye : wearer.eye) {
      eye.pupil_diameter = 0.006;
    }
    return support::wear(wearer, spectacles ? &pair : nullptr, {});
  }

  static std::vector<render::ViewSetup> views(const WornPair& pair) {
    std::vector<render::ViewSetup> views;
    for (const std::size_t side : {0U, 1U}) {
      views.push_back(support::view_along(pair, side, Viewing::gaze, {0.02, -0.03, -1.0}, kFields[side]));
      views.back().accommodation = 0.0;
    }
    return views;
  }

  static LiveConfig config(const Setting& setting, const WornPair& pair) {
    LiveConfig config;
    config.frame.width = kWidth;
    config.frame.height = kHeight;
    config.frame.mode = setting.mode;
    config.frame.bare = setting.bare;
    config.frame.samples = 2;
    config.frame.accuracy = setting.accuracy;
    config.frame.range = render::MapRange{-2.0, 2.0};
    if (setting.mode == Mode::adof) {
      const double blur = 1.5 * render::largest_blur(lenses::f64::Table{pair.model.table}, pair.eyes[0], Viewing::gaze,
                                                     0.6);  // and as much more as the lens has aside
      config.guard_px = render::guard_pixels(blur, kFields[0], kWidth, kHeight);
    }
    return config;
  }

  static std::vector<HiddenArea> hidden(double radius) {
    return {around_disc(kFields[0], radius), around_disc(kFields[1], radius, false)};
  }

  inline static render::vk::Device* device_ = nullptr;
  inline static render::Scene* scene_ = nullptr;
};

struct Difference {
  int seen = 0, seen_unlike = 0;  // pixels of which something shows
  int hidden = 0, black = 0;
};

Difference difference(const render::Image8& masked, const render::Image8& whole, const HiddenArea& area,
                      const FieldOfView& fov) {
  const PixelMask mask = tracking::hidden_pixels(area, fov, masked.width, masked.height);
  Difference d;
  for (std::size_t i = 0; i < mask.hidden.size(); ++i) {
    const auto a = std::span(masked.rgb).subspan(3 * i, 3), b = std::span(whole.rgb).subspan(3 * i, 3);
    if (mask.hidden[i] != 0) {
      ++d.hidden;
      d.black += a[0] + a[1] + a[2] == 0 ? 1 : 0;
    } else {
      ++d.seen;
      d.seen_unlike += std::ranges::equal(a, b) ? 0 : 1;
    }
  }
  return d;
}

std::vector<Setting> settings() {
  render::Accuracy corners = {}, in_double = {}, half = {}, foveated = {};
  corners.lens.spacing = 16;
  in_double.lens.in_double = true;
  half.resolution = 0.5;
  foveated.foveation = {5.0, 2};
  return {{"pinhole, a ray at a time", Mode::pinhole, false, false, Traversal::per_ray},
          {"adof, no lens", Mode::adof, false},
          {"adof", Mode::adof, true, true},
          {"adof, interpolated lens", Mode::adof, true, true, Traversal::tile, corners},
          {"adof, lens in double", Mode::adof, true, true, Traversal::tile, in_double},
          {"power", Mode::power},
          {"dof", Mode::dof, false},
          {"adof at half the resolution", Mode::adof, false, true, Traversal::tile, half},
          {"foveated adof", Mode::adof, false, true, Traversal::tile, foveated}};
}

TEST_F(MaskedFrame, WhatIsSeenIsTheSameToTheBitAndTheRestIsBlack) {
  for (const Setting& setting : settings()) {
    SCOPED_TRACE(setting.name);
    render::Renderer renderer(*device_, *scene_, {.traversal = setting.traversal});
    const WornPair pair = worn(setting.spectacles);
    const auto both = views(pair);
    LiveConfig config = this->config(setting, pair);
    render::LiveFrame whole(renderer, pair.model, both, config, {{}, {}});
    config.hidden = hidden(0.13);
    render::LiveFrame masked(renderer, pair.model, both, config, {{}, {}});
    for (const std::size_t eye : {0U, 1U}) {
      const render::Image8 picture = masked.read_picture(eye);
      const Difference d = difference(picture, whole.read_picture(eye), config.hidden->at(eye), both[eye].view.fov);
      EXPECT_EQ(d.seen_unlike, 0) << eye << ", of " << d.seen;
      // Whole tiles of what is hidden beyond a guard band, which is twice as wide at half the resolution.
      const bool composed = setting.accuracy.resolution < 1.0 || setting.accuracy.foveation.rate > 1;
      EXPECT_GT(d.black, (composed ? 0.1 : config.guard_px > 0 ? 0.5 : 0.9) * d.hidden) << eye;
    }
    EXPECT_GT(masked.hidden_fraction(), 0.3);
    EXPECT_GT(masked.left_out_fraction(), 0.1);
    EXPECT_LT(masked.left_out_fraction(), masked.hidden_fraction() + 0.05);
    EXPECT_EQ(whole.left_out_fraction(), 0.0);
  }
}

// A card so near that its print is spread over 20 pixels: its light comes from far beyond what is seen.
TEST_F(MaskedFrame, TheBandHoldsAllThatABlurGathers) {
  render::Scene scene = support::dark_scene();
  render::Material print = support::unlit(glm::vec4(1.0F));
  print.base_colour_texture.index = support::add_texture(scene, 64, 64, [](std::uint32_t x, std::uint32_t y) {
    const std::uint32_t v = (x / 2 + y / 2) % 2 == 0 ? 235 : 30;
    return glm::uvec4(v, v, v, 255);
  });
  support::add_wall(scene, support::add_material(scene, print), 0.0F, 0.0F, 0.06F, 0.2F);
  render::Renderer renderer(*device_, scene);
  const WornPair pair = worn(false);
  const auto both = views(pair);
  const Setting setting{"", Mode::adof, false, true};
  LiveConfig config = this->config(setting, pair);
  config.guard_px = render::guard_pixels(
      render::largest_blur(lenses::f64::Table{pair.model.table}, pair.eyes[0], Viewing::gaze, 0.058), kFields[0],
      kWidth, kHeight);
  EXPECT_GT(config.guard_px, 20);
  int cut_off = 0;
  for (const bool guarded : {true, false}) {
    config.guard_px = guarded ? config.guard_px : 0;
    config.hidden.reset();
    render::LiveFrame whole(renderer, pair.model, both, config, {{}, {}});
    config.hidden = hidden(0.07);
    render::LiveFrame masked(renderer, pair.model, both, config, {{}, {}});
    const Difference d =
        difference(masked.read_picture(0), whole.read_picture(0), config.hidden->at(0), both[0].view.fov);
    EXPECT_GT(d.black, 1000);
    EXPECT_TRUE(!guarded || d.seen_unlike == 0) << d.seen_unlike << " of " << d.seen;
    cut_off += guarded ? 0 : d.seen_unlike;
  }
  EXPECT_GT(cut_off, 0) << "the picture would not have shown a band too narrow";
}

TEST_F(MaskedFrame, WhatIsHiddenMayChangeWhileThePictureRuns) {
  render::vk::Device device({.validation = true});
  render::Renderer renderer(device, *scene_);
  const WornPair pair = worn(false);
  auto both = views(pair);
  LiveConfig config = this->config({"", Mode::pinhole, false, true}, pair);
  render::LiveFrame whole(renderer, pair.model, both, config, {{}, {}});
  EXPECT_THROW(whole.hide(hidden(0.1)), std::invalid_argument);
  config.hidden = std::vector<HiddenArea>(2);  // nothing yet
  render::LiveFrame live(renderer, pair.model, both, config, {{}, {}});
  EXPECT_EQ(live.left_out_fraction(), 0.0);
  const std::size_t kernels = renderer.kernels_made();
  const auto expect_hidden = [&](const std::vector<HiddenArea>& areas, bool any) {
    const std::span<const std::uint32_t> none;
    whole.start(pair.model, both, none);
    live.start(pair.model, both, none);
    for (const std::size_t eye : {0U, 1U}) {
      const Difference d = difference(live.read_picture(eye), whole.read_picture(eye), areas[eye], both[eye].view.fov);
      EXPECT_EQ(d.seen_unlike, 0) << eye;
      EXPECT_EQ(d.black > 0.8 * d.hidden && d.hidden > 0, any) << eye << ": " << d.black << " of " << d.hidden;
    }
  };
  const std::vector<HiddenArea> nothing(2);
  expect_hidden(nothing, false);
  for (const double radius : {0.13, 0.17, 0.1}) {
    live.hide(hidden(radius));
    expect_hidden(hidden(radius), true);
  }
  // A runtime may move the edges of its views: the mask stays where the lenses are.
  for (render::ViewSetup& view : both) {
    view.view.fov.tan_left += 0.05;
    view.view.fov.tan_up -= 0.04;
  }
  expect_hidden(hidden(0.1), true);
  live.hide(nothing);
  expect_hidden(nothing, false);
  EXPECT_EQ(renderer.kernels_made(), kernels);
  EXPECT_THROW(live.hide(std::vector<HiddenArea>(1)), std::invalid_argument);
  EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

TEST_F(MaskedFrame, BothPairsOfAnEyeShareItsMask) {
  render::Renderer renderer(*device_, *scene_);
  const WornPair pair = worn(false);
  auto four = views(pair);
  for (const std::size_t eye : {0U, 1U}) {
    four.push_back(four[eye]);
    four.back().tint = glm::dvec3(0.5);
  }
  LiveConfig config = this->config({"", Mode::pinhole, false, true}, pair);
  config.pairs = 2;
  render::LiveFrame whole(renderer, pair.model, four, config, {{}, {}});
  config.hidden = hidden(0.13);
  render::LiveFrame masked(renderer, pair.model, four, config, {{}, {}});
  for (const std::size_t eye : {0U, 1U}) {
    const render::Image8 picture = masked.read_picture(eye), all = whole.read_picture(eye);
    const PixelMask mask = tracking::hidden_pixels(config.hidden->at(eye), four[eye].view.fov, kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const auto at = static_cast<std::size_t>(y * kWidth + x);
        if (mask.hidden[at] == 0) {
          ASSERT_TRUE(std::equal(picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * at),
                                 picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * at + 3),
                                 all.rgb.begin() + static_cast<std::ptrdiff_t>(3 * at)))
              << x << " " << y;
        }
      }
    }
    EXPECT_EQ(picture.rgb[3 * 20], 0) << "left, above";
    EXPECT_EQ(picture.rgb[3 * (kWidth - 20)], 0) << "right, above";
  }
}

}  // namespace
