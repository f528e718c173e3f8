// The same view gives the same bits, whatever was rendered before it, beside it or in its other half.
#include <gtest/gtest.h>

#include "render/image/exr.hpp"
#include "render/image/png.hpp"
#include "render/vk/device.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/worn_views.hpp"

namespace {

using render::Mode;
using render::RenderedFrame;
using render::RenderedView;
using render::ViewSetup;
using support::WornPair;

const tracking::FieldOfView kField{.tan_left = 0.6, .tan_right = 0.5, .tan_down = 0.7, .tan_up = 0.4};
const std::array kModes{Mode::pinhole,     Mode::adof,          Mode::dof, Mode::power,
                        Mode::astigmatism, Mode::accommodation, Mode::blur};

render::FrameConfig frame_config(Mode mode) {
  render::FrameConfig config;
  config.width = 75;
  config.height = 61;
  config.mode = mode;
  config.samples = 4;
  config.seed = 5;
  config.range = render::MapRange{-3.0, 3.0};
  config.keep_radiance = !render::is_map(mode);
  config.keep_wavefront = true;
  return config;
}

void expect_same(const RenderedView& a, const RenderedView& b) {
  EXPECT_TRUE(a.display.rgb == b.display.rgb);
  EXPECT_TRUE(a.radiance == b.radiance);
  EXPECT_TRUE(a.wavefront.v_hh == b.wavefront.v_hh);
  EXPECT_TRUE(a.wavefront.v_hv == b.wavefront.v_hv);
  EXPECT_TRUE(a.wavefront.v_vv == b.wavefront.v_vv);
  EXPECT_TRUE(a.wavefront.accommodation == b.wavefront.accommodation);
  EXPECT_TRUE(a.wavefront.blur == b.wavefront.blur);
  EXPECT_TRUE(a.wavefront.depth == b.wavefront.depth);
}

void expect_same(const RenderedFrame& a, const RenderedFrame& b) {
  ASSERT_EQ(a.views.size(), b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    expect_same(a.views[i], b.views[i]);
  }
}

class RepeatedFrames : public testing::Test {
 protected:
  static lenses::Spectacles progressive() {
    return lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/presbyopia_bspline_torus.json");
  }
  [[nodiscard]] WornPair worn(const lenses::Spectacles& spectacles, const glm::dvec3& step = glm::dvec3(0.0),
                              double turn = 0.0) const {
    tracking::Pose pose = scene_.start_pose().value();
    pose.position += step;
    pose.orientation = pose.orientation * tracking::orientation_from_yaw_pitch(turn, -0.5 * turn);
    lenses::Wearer wearer;
    wearer.age = 62.0;
    return support::wear(wearer, &spectacles, pose);
  }
  [[nodiscard]] glm::dvec3 target(const std::string& name) const { return support::target_position(scene_, name); }

  render::vk::Device device_;
  render::Scene scene_ = support::reading_room();
};

// Head, eye and lens move from frame to frame; nothing of an earlier frame may show.
TEST_F(RepeatedFrames, AreThoseOfAFreshRenderer) {
  lenses::Spectacles moved = progressive();
  moved.lens[0].fit.decentration = {0.004, -0.003};
  moved.lens[1].fit.pantoscopic_tilt = 0.2;
  lenses::Spectacles other = progressive();
  other.lens[0].front = lenses::Sphere{6.0};
  struct Step {
    WornPair pair;
    std::string target;
    render::Viewing viewing;
    Mode mode;
  };
  const std::vector<Step> steps{
      {worn(progressive()), "near_card", render::Viewing::gaze, Mode::adof},
      {worn(progressive(), {0.1, 0.05, -0.2}, 0.1), "near_card", render::Viewing::gaze, Mode::dof},    // the head
      {worn(progressive(), {0.1, 0.05, -0.2}, 0.1), "clock_dial", render::Viewing::gaze, Mode::adof},  // the eyes
      {worn(moved, {0.1, 0.05, -0.2}, 0.1), "clock_dial", render::Viewing::gaze, Mode::adof},          // the lens
      {worn(other), "screen", render::Viewing::scanning, Mode::blur},                                  // another lens
      {worn(progressive()), "near_card", render::Viewing::gaze, Mode::adof}};  // back at the start
  render::Renderer lasting(device_, scene_);
  std::vector<RenderedFrame> frames;
  for (const Step& step : steps) {
    const auto views = support::views_at(step.pair, step.viewing, target(step.target), kField);
    frames.push_back(lasting.render(step.pair.model, views, frame_config(step.mode)));
    render::Renderer fresh(device_, scene_);
    expect_same(frames.back(), fresh.render(step.pair.model, views, frame_config(step.mode)));
  }
  expect_same(frames.front(), frames.back());
  // And the steps do differ, or their sameness says nothing.
  for (std::size_t i = 1; i + 1 < frames.size(); ++i) {
    EXPECT_FALSE(frames[i].views[0].wavefront.depth == frames[i - 1].views[0].wavefront.depth) << "step " << i;
  }
}

// A running picture waits for no compiler: every kernel is there once its settings are prepared, whatever moves then.
TEST_F(RepeatedFrames, CompileNothingOncePrepared) {
  for (const Mode mode : kModes) {
    render::Renderer renderer(device_, scene_);
    const auto pair = worn(progressive());
    const auto views = support::views_at(pair, render::Viewing::gaze, target("near_card"), kField);
    renderer.prepare(pair.model, views, frame_config(mode));
    const std::size_t prepared = renderer.kernels_made();
    EXPECT_GT(prepared, 0U);
    (void)renderer.render(pair.model, views, frame_config(mode));
    const auto turned = worn(progressive(), {0.1, 0.05, -0.2}, 0.1);
    const auto elsewhere = support::views_at(turned, render::Viewing::gaze, target("clock_dial"), kField);
    (void)renderer.render(turned.model, elsewhere, frame_config(mode));
    EXPECT_EQ(renderer.kernels_made(), prepared) << static_cast<int>(mode);
  }
}

TEST_F(RepeatedFrames, OfTwoEyesAreThoseOfEachEyeAlone) {
  lenses::Spectacles unlike = progressive();
  unlike.lens[1] = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/myopia.json").lens[1];
  render::Renderer renderer(device_, scene_);
  for (const lenses::Spectacles& spectacles : {progressive(), unlike}) {
    const auto pair = worn(spectacles);
    for (const Mode mode : kModes) {
      SCOPED_TRACE(static_cast<int>(mode));
      const auto views = support::views_at(pair, render::Viewing::gaze, target("near_card"), kField);
      const auto both = renderer.render(pair.model, views, frame_config(mode));
      ASSERT_EQ(both.views.size(), 2U);
      for (const std::size_t i : {0U, 1U}) {
        const auto alone = renderer.render(pair.model, {views[i]}, frame_config(mode));
        expect_same(both.views[i], alone.views.front());
      }
    }
  }
}

// Columns of the program's pictures: 40 pixels an eye, left eye left; with --compare A fills the left half of each eye.
constexpr int kColumns = 40, kRows = 32;

class ComparedPictures : public testing::Test {
 protected:
  std::string rendered(const std::string& name, const std::vector<std::string>& more) {
    const std::string file = (folder_.path() / name).string();
    std::vector<std::string> words{"render",       "--wearer", VERGENCE_ASSETS "/wearers/presbyopia.json",
                                   "--spectacles", kPair,      "--look-at",
                                   "near_card",    "--size",   "40x32",
                                   "--output",     file};
    words.insert(words.end(), more.begin(), more.end());
    const auto result = support::run_program({.arguments = words});
    EXPECT_EQ(result.exit_status, 0) << result.err;
    return file;
  }
  static bool is_divider(int x) { return x % kColumns == kColumns / 2 || x % kColumns == kColumns / 2 - 1; }

  static constexpr const char* kPair = VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json";
  support::TemporaryFolder folder_;
};

TEST_F(ComparedPictures, OfOnePairWithItselfAreThePictureWithoutComparison) {
  for (const std::string mode : {"adof", "dof", "pinhole"}) {
    SCOPED_TRACE(mode);
    const std::vector<std::string> plain{"--mode", mode, "--samples", "4"};
    auto compared = plain;
    compared.insert(compared.end(), {"--compare", kPair});
    const auto one = render::read_png(rendered("one.png", plain));
    const auto two = render::read_png(rendered("two.png", compared));
    ASSERT_EQ(one.width, 2 * kColumns);
    ASSERT_EQ(one.height, kRows);
    ASSERT_EQ(two.width, one.width);
    ASSERT_EQ(two.height, one.height);
    std::size_t different = 0, not_white = 0;
    for (std::size_t i = 0; i < one.rgb.size(); ++i) {
      if (is_divider(static_cast<int>(i / 3) % one.width)) {
        not_white += two.rgb[i] != 255 ? 1 : 0;
      } else {
        different += one.rgb[i] != two.rgb[i] ? 1 : 0;
      }
    }
    EXPECT_EQ(different, 0U);
    EXPECT_EQ(not_white, 0U);
  }
}

TEST_F(ComparedPictures, AgreeInEveryChannel) {
  const auto one = render::read_exr(rendered("one.exr", {"--channels", "all"}));
  const auto two = render::read_exr(rendered("two.exr", {"--channels", "all", "--compare", kPair}));
  ASSERT_EQ(one.channels, two.channels);
  ASSERT_EQ(one.channels.size(), 9U);
  for (std::size_t c = 0; c < one.channels.size(); ++c) {
    EXPECT_TRUE(one.planes[c] == two.planes[c]) << one.channels[c];
  }
}

// B is on the right: only there does another pair change the picture.
TEST_F(ComparedPictures, ShowTheSecondPairRightOfTheDivider) {
  const auto one = render::read_png(rendered("one.png", {}));
  const auto two = render::read_png(rendered("two.png", {"--compare", "none"}));
  std::array<std::size_t, 2> different{};
  for (std::size_t i = 0; i < one.rgb.size(); ++i) {
    const int x = static_cast<int>(i / 3) % one.width;
    if (!is_divider(x) && one.rgb[i] != two.rgb[i]) {
      ++different[x % kColumns < kColumns / 2 ? 0 : 1];
    }
  }
  EXPECT_EQ(different[0], 0U);
  EXPECT_GT(different[1], 1000U);
}

}  // namespace
