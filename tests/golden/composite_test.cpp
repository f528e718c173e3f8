// Pictures traced at fewer pixels than they show: what must stay as it is, and where no border may be seen.
#include "render/composite.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "render/image/image.hpp"
#include "render/vk/device.hpp"
#include "tests/support/lit_scene.hpp"

namespace {

using render::FrameConfig;
using render::Mode;
using render::RenderedFrame;
using render::Viewing;
using support::WornPair;

constexpr int kSide = 96;
constexpr double kHalfTangent = 0.35;  // 38.6 degrees

// A wall of print-like checks with a post in front of it; beside it all is one colour or a ramp.
render::Scene checks() {
  render::Scene scene = support::dark_scene();
  render::Material print = support::unlit(glm::vec4(1.0F));
  print.base_colour_texture.index = support::add_texture(scene, 128, 128, [](std::uint32_t x, std::uint32_t y) {
    const std::uint32_t v = (x / 3 + y / 5) % 2 == 0 ? 230 : 40;
    return glm::uvec4(v, v / 2 + 60, 255 - v, 255);
  });
  support::add_wall(scene, support::add_material(scene, print), 0.0F, 0.0F, 2.0F, 1.2F);
  const auto post = support::add_material(scene, support::unlit({0.9F, 0.8F, 0.1F, 1.0F}));
  support::add_wall(scene, post, 0.05F, -0.1F, 0.7F, 0.08F);
  return scene;
}

render::Scene plain(const glm::vec4& colour) {
  render::Scene scene = support::dark_scene();
  support::add_wall(scene, support::add_material(scene, support::unlit(colour)), 0.0F, 0.0F, 1.0F, 3.0F);
  return scene;
}

render::Scene ramp() {
  render::Scene scene = support::dark_scene();
  render::Material slope = support::unlit(glm::vec4(1.0F));
  slope.base_colour_texture.index = support::add_texture(scene, 64, 64, [](std::uint32_t x, std::uint32_t y) {
    const std::uint32_t v = 40 + 2 * x + y;
    return glm::uvec4(v, v, v, 255);
  });
  support::add_wall(scene, support::add_material(scene, slope), 0.0F, 0.0F, 1.0F, 0.6F);
  return scene;
}

class Composite : public testing::Test {
 protected:
  static void SetUpTestSuite() { device_ = new render::vk::Device(); }
  static void TearDownTestSuite() { delete device_; }

  // A 70-year-old, who accommodates to nothing near, so that what is near is blurred.
  static WornPair worn() {
    lenses::Wearer wearer;
    wearer.age = 70.0;
    tracking::Pose head;
    head.position = {-wearer.pupillary_distance[0], 0.0, 0.0};  // the right eye at the origin
    return support::wear(wearer, nullptr, head);
  }

  // The picture is centred straight ahead; the gaze may be elsewhere.
  static render::ViewSetup view(const WornPair& pair, std::size_t side = 0, const glm::dvec3& gaze = {0, 0, -1}) {
    const tracking::FieldOfView fov{kHalfTangent, kHalfTangent, kHalfTangent, kHalfTangent};
    render::ViewSetup setup = support::view_along(pair, side, Viewing::fixed, {0, 0, -1}, fov);
    setup.view.gaze = glm::normalize(gaze);
    return setup;
  }

  static FrameConfig config(Mode mode, int width = kSide, int height = kSide) {
    FrameConfig config;
    config.width = width;
    config.height = height;
    config.mode = mode;
    config.samples = 4;
    config.keep_radiance = true;
    config.keep_wavefront = true;
    return config;
  }

  static FrameConfig foveated(FrameConfig config, double fovea_deg, int rate) {
    config.accuracy.foveation = {fovea_deg, rate};
    return config;
  }
  static FrameConfig reduced(FrameConfig config, double resolution) {
    config.accuracy.resolution = resolution;
    return config;
  }

  // Degrees from the gaze of a pixel's middle.
  static double angle_at(const render::ViewSetup& setup, int x, int y) {
    const glm::dvec3 d(kHalfTangent * (2.0 * (x + 0.5) / kSide - 1.0), kHalfTangent * (1.0 - 2.0 * (y + 0.5) / kSide),
                       -1.0);
    return glm::degrees(std::acos(std::clamp(glm::dot(glm::normalize(d), setup.view.gaze), -1.0, 1.0)));
  }

  inline static render::vk::Device* device_ = nullptr;
};

double rms(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// No setting, and settings that leave all pixels: a resolution of 1, no fovea, a rate of 1, and a fovea as large as the
// picture, which goes through the layers.
TEST_F(Composite, FullResolutionIsTheSameToTheBit) {
  const render::Scene scene = checks();
  render::Renderer renderer(*device_, scene);
  const WornPair pair = worn();
  const FrameConfig standard = config(Mode::adof);
  const RenderedFrame expected = renderer.render(pair.model, {view(pair)}, standard);
  for (const FrameConfig& all :
       {reduced(standard, 1.0), foveated(standard, 10.0, 1), foveated(standard, 0.0, 4), foveated(standard, 60.0, 4)}) {
    const RenderedFrame frame = renderer.render(pair.model, {view(pair)}, all);
    EXPECT_EQ(frame.views[0].display.rgb, expected.views[0].display.rgb);
    EXPECT_EQ(frame.views[0].radiance, expected.views[0].radiance);
    EXPECT_EQ(frame.views[0].wavefront.v_hh, expected.views[0].wavefront.v_hh);
    EXPECT_EQ(frame.views[0].wavefront.depth, expected.views[0].wavefront.depth);
  }
}

TEST_F(Composite, AConstantPictureStaysConstant) {
  const glm::vec4 colour(0.5F, 0.25F, 0.75F, 1.0F);
  const render::Scene scene = plain(colour);
  render::Renderer renderer(*device_, scene);
  const WornPair pair = worn();
  for (const Mode mode : {Mode::pinhole, Mode::adof, Mode::dof}) {
    for (const FrameConfig& c : {reduced(config(mode), 0.5), reduced(config(mode), 0.37),
                                 foveated(config(mode), 5.0, 4), reduced(foveated(config(mode), 4.0, 3), 0.6)}) {
      const RenderedFrame frame = renderer.render(pair.model, {view(pair)}, c);
      for (std::size_t i = 0; i < frame.views[0].radiance.size(); ++i) {
        // A half float has eleven digits, and a mean of samples rounds once more.
        ASSERT_NEAR(frame.views[0].radiance[i], colour[static_cast<int>(i % 3)], 1e-3) << static_cast<int>(mode);
      }
    }
  }
}

// The fovea's layer traces the same directions; a part of a field of view rounds them elsewhere, so that a pixel on an
// edge may see its other side.
TEST_F(Composite, TheFoveaIsTheFullPicture) {
  const render::Scene scene = checks();
  render::Renderer renderer(*device_, scene);
  const WornPair pair = worn();
  for (const Mode mode : {Mode::pinhole, Mode::adof}) {
    const RenderedFrame full = renderer.render(pair.model, {view(pair)}, config(mode));
    const RenderedFrame frame = renderer.render(pair.model, {view(pair)}, foveated(config(mode), 6.0, 4));
    int inside = 0, same = 0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        if (angle_at(view(pair), x, y) > 6.0) {
          continue;
        }
        const auto at = 3 * static_cast<std::size_t>(y * kSide + x);
        int largest = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          largest = std::max(
              largest, std::abs(int{frame.views[0].display.rgb[at + c]} - int{full.views[0].display.rgb[at + c]}));
        }
        ++inside;
        same += largest <= 1 ? 1 : 0;
      }
    }
    EXPECT_GT(inside, 500) << "6 degrees are 15 pixels";
    EXPECT_GE(same, inside * 98 / 100) << "of " << inside << ", mode " << static_cast<int>(mode);
    EXPECT_GT(rms(frame.views[0].radiance, full.views[0].radiance), 0.01) << "beyond, something is left out";
  }
}

// Where the picture itself is smooth, no step between neighbours is larger than the full picture's largest.
TEST_F(Composite, NoBorderIsSeen) {
  const render::Scene scene = ramp();
  render::Renderer renderer(*device_, scene);
  const WornPair pair = worn();
  const auto largest_step = [](const std::vector<float>& radiance) {
    double largest = 0.0;
    const auto value = [&](int x, int y) { return radiance[3 * static_cast<std::size_t>(y * kSide + x)]; };
    for (int y = 1; y < kSide; ++y) {
      for (int x = 1; x < kSide; ++x) {
        largest = std::max<double>(
            {largest, std::abs(value(x, y) - value(x - 1, y)), std::abs(value(x, y) - value(x, y - 1))});
      }
    }
    return largest;
  };
  const auto full = renderer.render(pair.model, {view(pair)}, config(Mode::adof)).views[0].radiance;
  for (const int rate : {2, 4}) {
    const auto radiance =
        renderer.render(pair.model, {view(pair)}, foveated(config(Mode::adof), 5.0, rate)).views[0].radiance;
    // A texture's steps of a 255th are softened differently at another resolution.
    EXPECT_LE(largest_step(radiance), 1.5 * largest_step(full) + 0.002) << rate;
    EXPECT_LT(rms(radiance, full), 0.01) << rate;
  }
}

TEST_F(Composite, TheFoveaFollowsTheGaze) {
  const render::Scene scene = checks();
  render::Renderer renderer(*device_, scene);
  const WornPair pair = worn();
  const glm::dvec3 right(std::tan(0.2), 0.1, -1.0);
  const FrameConfig standard = config(Mode::pinhole);
  const auto full = renderer.render(pair.model, {view(pair, 0, right)}, standard).views[0].radiance;
  const auto frame = renderer.render(pair.model, {view(pair, 0, right)}, foveated(standard, 5.0, 4)).views[0].radiance;
  double near = 0.0, far = 0.0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const auto at = 3 * static_cast<std::size_t>(y * kSide + x);
      const double difference = std::abs(frame[at] - full[at]);
      const double angle = angle_at(view(pair, 0, right), x, y);
      (angle < 5.0 ? near : far) += angle < 5.0 || angle > 8.0 ? difference : 0.0;
    }
  }
  EXPECT_LT(near, 0.02 * far);
  // Out of the picture: nothing but the coarse layer.
  const auto away = plan_composite(foveated(standard, 5.0, 4), {view(pair, 0, {0.0, 1.0, -0.2})});
  EXPECT_FALSE(away.fovea);
  EXPECT_EQ(away.whole.config.width, kSide / 4);
}

// Two eyes that look to different places: each as if drawn alone, but for where its layer begins.
TEST_F(Composite, BothEyesTogetherAreEachAlone) {
  const render::Scene scene = checks();
  render::Renderer renderer(*device_, scene);
  const WornPair pair = worn();
  const std::vector<render::ViewSetup> eyes{view(pair, 0, {-0.2, 0.0, -1.0}), view(pair, 1, {0.1, -0.1, -1.0})};
  for (const FrameConfig& c : {reduced(config(Mode::adof), 0.5), foveated(config(Mode::adof), 5.0, 3)}) {
    const RenderedFrame both = renderer.render(pair.model, eyes, c);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
      const RenderedFrame alone = renderer.render(pair.model, {eyes[i]}, c);
      EXPECT_LT(rms(both.views[i].radiance, alone.views[0].radiance), 0.01) << i;
    }
  }
}

TEST_F(Composite, FewerPixelsAreFurtherFromTheFullPicture) {
  const render::Scene scene = checks();
  render::Renderer renderer(*device_, scene);
  const WornPair pair = worn();
  const auto full = renderer.render(pair.model, {view(pair)}, config(Mode::adof)).views[0].radiance;
  double last = 0.0;
  for (const double resolution : {0.75, 0.5, 0.25}) {
    const auto frame = renderer.render(pair.model, {view(pair)}, reduced(config(Mode::adof), resolution));
    const double error = rms(frame.views[0].radiance, full);
    EXPECT_GT(error, last) << resolution;
    last = error;
  }
}

TEST_F(Composite, AnySizeIsDrawn) {
  const render::Scene scene = checks();
  render::Renderer renderer(*device_, scene);
  const WornPair pair = worn();
  for (const glm::ivec2& size : {glm::ivec2(1, 1), glm::ivec2(1, 7), glm::ivec2(5, 3), glm::ivec2(33, 17)}) {
    for (FrameConfig c :
         {reduced(config(Mode::adof, size.x, size.y), 0.5), reduced(config(Mode::adof, size.x, size.y), 0.01),
          foveated(config(Mode::adof, size.x, size.y), 5.0, 4),
          reduced(foveated(config(Mode::adof, size.x, size.y), 3.0, 7), 0.5)}) {
      const RenderedFrame frame = renderer.render(pair.model, {view(pair, 0), view(pair, 1)}, c);
      ASSERT_EQ(frame.views.size(), 2U);
      for (const auto& seen : frame.views) {
        EXPECT_EQ(seen.display.rgb.size(), 3U * static_cast<std::size_t>(size.x * size.y));
        EXPECT_TRUE(std::ranges::all_of(seen.radiance, [](float v) { return std::isfinite(v) && v >= 0.0F; }));
        EXPECT_EQ(seen.wavefront.depth.size(), static_cast<std::size_t>(size.x * size.y));
      }
    }
  }
}

TEST(CompositePlan, ThresholdsCountShownPixels) {
  FrameConfig config;
  config.width = config.height = 200;
  config.threshold_px = 0.5;
  config.accuracy.resolution = 0.25;
  render::ViewSetup view;
  view.view.fov = {0.3, 0.3, 0.3, 0.3};
  const auto plan = plan_composite(config, {view});
  EXPECT_EQ(plan.whole.config.width, 50);
  EXPECT_DOUBLE_EQ(plan.whole.config.threshold_px, 0.125);
  EXPECT_FALSE(render::is_composed(plan.whole.config)) << "a layer is drawn as it is";
  config.mode = Mode::power;
  EXPECT_FALSE(render::is_composed(config)) << "maps are drawn in full";
}

}  // namespace
