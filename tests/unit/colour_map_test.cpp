// The colour maps: their ends, their order, and that C++ and GLSL make the same colours of one text.
#include "render/image/gpu/colour_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/image/srgb.hpp"
#include "render/vk/commands.hpp"
#include "shaders/colours.hpp"

namespace render::gpu {
namespace {

void expect_colour(const vec3& colour, float r, float g, float b) {
  EXPECT_FLOAT_EQ(colour.r, r);
  EXPECT_FLOAT_EQ(colour.g, g);
  EXPECT_FLOAT_EQ(colour.b, b);
}

// CIE relative luminance of a display-encoded colour.
double luminance(const vec3& colour) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
}

TEST(HueMap, RunsFromBlueOverGreenToRed) {
  expect_colour(colour_map(kHueMap, 0.0F), 0.0F, 0.0F, 1.0F);
  expect_colour(colour_map(kHueMap, 0.25F), 0.0F, 1.0F, 1.0F);
  expect_colour(colour_map(kHueMap, 0.5F), 0.0F, 1.0F, 0.0F);
  expect_colour(colour_map(kHueMap, 0.75F), 1.0F, 1.0F, 0.0F);
  expect_colour(colour_map(kHueMap, 1.0F), 1.0F, 0.0F, 0.0F);
}

TEST(HueMap, IsFullySaturatedEverywhere) {
  for (int i = 0; i <= 1000; ++i) {
    const vec3 colour = colour_map(kHueMap, static_cast<float>(i) / 1000.0F);
    EXPECT_EQ(std::max({colour.r, colour.g, colour.b}), 1.0F);
    EXPECT_EQ(std::min({colour.r, colour.g, colour.b}), 0.0F);
  }
}

TEST(PerceptualMap, EndsAreDarkVioletAndYellow) {
  expect_colour(colour_map(kPerceptualMap, 0.0F), 0.267F, 0.005F, 0.329F);
  expect_colour(colour_map(kPerceptualMap, 1.0F), 0.993F, 0.906F, 0.144F);
}

TEST(PerceptualMap, GrowsLighterThroughout) {
  double before = -1.0;
  for (int i = 0; i <= 1000; ++i) {
    const double now = luminance(colour_map(kPerceptualMap, static_cast<float>(i) / 1000.0F));
    EXPECT_GT(now, before) << i;
    before = now;
  }
}

TEST(ColourMaps, ClampWhatLiesOutside) {
  for (const int which : {kHueMap, kPerceptualMap}) {
    const vec3 low = colour_map(which, 0.0F), high = colour_map(which, 1.0F);
    EXPECT_EQ(colour_map(which, -3.0F), low);
    EXPECT_EQ(colour_map(which, std::numeric_limits<float>::quiet_NaN()), low);
    EXPECT_EQ(colour_map(which, 7.0F), high);
    EXPECT_EQ(colour_map(which, std::numeric_limits<float>::infinity()), high);
  }
}

TEST(ColourMaps, AreTheSameOnTheDevice) {
  struct Push {
    std::int32_t which;
    std::uint32_t count;
  };
  constexpr std::uint32_t kCount = 1024;
  std::vector<float> places(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) places[i] = static_cast<float>(i) / 1000.0F - 0.012F;

  vk::Device device({.validation = true});
  vk::Buffer in(device, kCount * sizeof(float), vk::Memory::upload), out(device, kCount * 16, vk::Memory::readback);
  in.write(places);
  const vk::Kernel kernel(device, shaders::colours,
                          std::array{vk::Binding::storage_buffer, vk::Binding::storage_buffer}, sizeof(Push));
  for (const int which : {kHueMap, kPerceptualMap}) {
    vk::Commands commands(device);
    commands.dispatch(kernel, {&in, &out}, vk::bytes_of(Push{which, kCount}), kCount / 64);
    device.run(commands);
    const auto colours = out.read<float>(4 * kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      const vec3 expected = colour_map(which, places[i]);
      for (std::size_t c = 0; c < 3; ++c) {
        // A few roundings of values near 15, where a knot's two sides meet without a jump.
        EXPECT_NEAR(colours[4 * i + c], expected[static_cast<int>(c)], 4e-6F) << which << " at " << places[i];
      }
    }
  }
  EXPECT_TRUE(device.validation_messages().empty());
}

}  // namespace
}  // namespace render::gpu
