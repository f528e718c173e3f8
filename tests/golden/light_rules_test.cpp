// What a picture's numbers mean: linear radiance until the end, sRGB once, one exposure, blur before clamping.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "render/image/exr.hpp"
#include "render/image/png.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/tiny_scene.hpp"

namespace {

using render::FloatImage;
using render::Image8;

class LightRules : public testing::Test {
 protected:
  // A wall of radiance 0.5 two metres ahead.
  void write_wall() { write_scene({support::wall(2.0F, 4.0F, 0.5F)}); }
  void write_scene(const std::vector<support::Patch>& patches) {
    scene_ = folder_.write("scene.gltf", support::patch_gltf(patches, {{"spot", {0.0F, 0.0F, -2.0F}}}).text());
  }

  std::string rendered(const std::string& name, const std::vector<std::string>& more) {
    const std::string file = (folder_.path() / name).string();
    std::vector<std::string> words{"render", "--scene", scene_, "--eye", "right", "--output", file};
    words.insert(words.end(), more.begin(), more.end());
    const auto result = support::run_program({.arguments = words});
    EXPECT_EQ(result.exit_status, 0) << result.err;
    return file;
  }

  support::TemporaryFolder folder_;
  std::string scene_;
};

std::pair<int, int> extremes(const Image8& image) {
  const auto [low, high] = std::ranges::minmax(image.rgb);
  return {low, high};
}

const std::vector<float>& plane(const FloatImage& image, const std::string& channel) {
  const auto place = std::ranges::find(image.channels, channel);
  return image.planes.at(static_cast<std::size_t>(place - image.channels.begin()));
}

// IEC 61966-2-1: 0.5 is 1.055 * 0.5^(1/2.4) - 0.055 = 0.7354 of 255 = 187.5, so 188; one EV more is full scale.
TEST_F(LightRules, RadianceIsEncodedOnceAndExposureDoublesIt) {
  write_wall();
  for (const std::string mode : {"pinhole", "adof", "dof"}) {
    SCOPED_TRACE(mode);
    const std::vector<std::string> common{"--mode", mode, "--samples", "4", "--size", "16x16", "--exposure"};
    const auto at = [&](const std::string& exposure) {
      auto words = common;
      words.push_back(exposure);
      return extremes(render::read_png(rendered("wall.png", words)));
    };
    EXPECT_EQ(at("0"), std::pair(188, 188));
    if (mode != "adof") {
      continue;  // they share what follows
    }
    EXPECT_EQ(at("1"), std::pair(255, 255));
    EXPECT_EQ(at("3"), std::pair(255, 255));
    // 0.25 is 136.96 of 255.
    EXPECT_EQ(at("-1"), std::pair(137, 137));
  }
}

// Radiance as it is in the scene, whatever the exposure of the display.
TEST_F(LightRules, ExrIsLinear) {
  write_wall();
  for (const std::string exposure : {"0", "2"}) {
    const auto image = render::read_exr(rendered("wall.exr", {"--size", "16x16", "--exposure", exposure}));
    EXPECT_EQ(image.channels.size(), 3U);
    for (const char* channel : {"R", "G", "B"}) {
      for (const float value : plane(image, channel)) {
        ASSERT_EQ(value, 0.5F);  // a half float holds it exactly
      }
    }
  }
}

TEST_F(LightRules, PngIsMarkedAsSrgbOnce) {
  write_wall();
  std::ifstream in(rendered("wall.png", {"--size", "16x16"}), std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  std::vector<std::string> chunks;
  for (std::size_t at = 8; at + 8 <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      length = length << 8U | static_cast<unsigned char>(bytes[at + i]);
    }
    chunks.push_back(bytes.substr(at + 4, 4));
    at += length + 12;
  }
  EXPECT_EQ(std::ranges::count(chunks, "sRGB"), 1);
  // Other statements about colour would compete with it.
  EXPECT_EQ(std::ranges::count(chunks, "gAMA") + std::ranges::count(chunks, "iCCP"), 0);
  ASSERT_FALSE(chunks.empty());
  EXPECT_LT(std::ranges::find(chunks, "sRGB"), std::ranges::find(chunks, "IDAT"));
}

// A small lamp of radiance 100, far brighter than the display's white, seen out of focus by 3 D: the light of the
// blurred disc is the light of the sharp lamp. Clamped before blurring it would be a hundredth.
TEST_F(LightRules, BlurSpreadsLightBeforeItIsClamped) {
  const float half = 0.02F;  // 1.1 degrees at 2 m: many pixels, as the sum of a few would be a matter of luck
  write_scene({support::wall(2.5F, 6.0F, 0.0F), support::wall(2.0F, half, 100.0F)});
  const std::string myope = folder_.write(
      "myope.json", R"({"version": 1, "age": 70, "right": {"refraction": {"sphere": -3.5}}, "left": {}})");
  const auto sum = [&](const std::string& mode) {
    const auto image =
        render::read_exr(rendered(mode + ".exr", {"--wearer", myope, "--viewing", "fixed", "--mode", mode, "--samples",
                                                  "256", "--fov", "8", "--size", "128x128"}));
    const auto& green = plane(image, "G");
    return std::pair(std::accumulate(green.begin(), green.end(), 0.0), *std::ranges::max_element(green));
  };
  const auto [sharp, sharp_peak] = sum("pinhole");
  const auto [gathered, gathered_peak] = sum("adof");
  const auto [distributed, distributed_peak] = sum("dof");
  EXPECT_EQ(sharp_peak, 100.0F);
  EXPECT_NEAR(gathered / sharp, 1.0, 0.02);
  EXPECT_NEAR(distributed / sharp, 1.0, 0.02);
  // It did spread: 3.0 D and 3.5 mm blur by 36 arcmin across, and the lamp is 69.
  const auto image = render::read_exr((folder_.path() / "adof.exr").string());
  const auto lit = std::ranges::count_if(plane(image, "G"), [](float value) { return value > 1.0F; });
  const auto before = std::ranges::count_if(plane(render::read_exr((folder_.path() / "pinhole.exr").string()), "G"),
                                            [](float value) { return value > 1.0F; });
  EXPECT_GT(static_cast<double>(lit), 1.8 * static_cast<double>(before));
}

// Nothing is blurred that is in focus: an emmetrope who can accommodate sees the pinhole picture.
TEST_F(LightRules, AdofInFocusIsThePinholePicture) {
  write_scene({support::wall(2.0F, 4.0F, 0.2F), support::wall(1.9999F, 0.1F, 0.8F)});
  for (const std::string viewing : {"fixed", "scanning", "gaze"}) {
    SCOPED_TRACE(viewing);
    const auto picture = [&](const std::string& mode) {
      return render::read_exr(rendered(mode + ".exr", {"--look-at", "spot", "--viewing", viewing, "--mode", mode,
                                                       "--size", "64x64", "--fov", "30"}));
    };
    const auto sharp = picture("pinhole");
    EXPECT_EQ(sharp.planes, picture("adof").planes);
    EXPECT_NE(std::ranges::min(plane(sharp, "G")), std::ranges::max(plane(sharp, "G")));
  }
}

}  // namespace
