// What is drawn is what the compositor shows: linear light arrives encoded once, each eye's in its own half.
#include <gtest/gtest.h>

#include <array>
#include <chrono>

#include "tests/support/headset_picture.hpp"
#include "tests/support/lit_scene.hpp"
#include "tests/support/monado.hpp"
#include "tests/support/x_screen.hpp"

namespace {

using support::HeadsetProgram;
using tracking::Side;

constexpr int kHalf = 188;  // sRGB of linear 0.5, IEC 61966-2-1: 255 (1.055 0.5^(1/2.4) - 0.055) = 187.5

// Between two walls of half the light of white: the left eye before a green one, the right eye before a red one.
struct TwoColours : support::HeadsetPicture {
  explicit TwoColours(HeadsetProgram& program)
      : HeadsetPicture(program, two_walls(), glm::dquat(0.0, 0.0, 1.0, 0.0)) {}  // half a turn

  static render::Scene two_walls() {
    render::Scene scene = support::dark_scene();
    support::add_wall(scene, support::add_material(scene, support::unlit({0, 0.5F, 0, 1})), 0.0F, 0.0F, 2.0F, 4.0F);
    support::add_wall(scene, support::add_material(scene, support::unlit({0.5F, 0, 0, 1})), 0.0F, 0.0F, -2.0F, 4.0F);
    return scene;
  }

  // Draws and hands over; with a reader before the images are given back.
  template <class F>
  void show(HeadsetProgram& program, const xr::Frame& frame, F&& before_release) {
    before_release(start(program));
    program.loop.show(frame);
  }
};

void expect_all(const render::Image8& image, const std::array<int, 3>& colour) {
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    ASSERT_EQ(image.rgb[i], colour[i % 3]) << "byte " << i;
  }
}

TEST(SubmittedPixels, LinearHalfIsEncodedOnce) {
  const support::Monado monado;
  HeadsetProgram program({.size = std::array{48, 40}, .readable = true});
  TwoColours picture(program);
  const auto frame = program.next_visible();
  ASSERT_TRUE(frame);
  picture.show(program, *frame, [&](const std::array<std::uint32_t, 2>& images) {
    expect_all(picture.live->read_image(0, images[0]), {0, kHalf, 0});
    expect_all(picture.live->read_image(1, images[1]), {kHalf, 0, 0});
  });
  program.leave();
}

TEST(SubmittedPixels, BlueFirstImagesGetTheirBytesInThatOrder) {
  const support::Monado monado;
  HeadsetProgram program({.size = std::array{33, 17}, .readable = true});
  TwoColours picture(program);
  // The image that Monado gives is red first; its bytes read the wrong way round show that they were swapped.
  render::LiveConfig config;
  config.frame.width = 33;
  config.frame.height = 17;
  config.frame.mode = render::Mode::pinhole;
  config.blue_first = true;
  const auto& left = program.loop.swapchain(Side::left);
  const auto& right = program.loop.swapchain(Side::right);
  ASSERT_EQ(left.format(), VK_FORMAT_R8G8B8A8_SRGB);
  render::LiveFrame swapped(picture.renderer, picture.model, picture.views, config, {left.images(), right.images()});
  const auto frame = program.next_visible();
  ASSERT_TRUE(frame);
  const auto images = program.loop.acquire();
  swapped.start(picture.model, picture.views, std::array{images[1], images[0]});
  expect_all(picture.live->read_image(1, images[0]), {0, 0, kHalf});
  expect_all(swapped.read_image(1, images[0]), {kHalf, 0, 0});
  expect_all(swapped.read_picture(1), {kHalf, 0, 0});
  program.loop.show(*frame);
  program.leave();
}

std::array<int, 3> pixel(const render::Image8& image, int x, int y) {
  const std::size_t at = 3 * static_cast<std::size_t>(y * image.width + x);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

bool is_near(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  // The compositor resamples in linear light and encodes again: off by one, two where it rounds twice.
  return std::abs(a[0] - b[0]) <= 2 && std::abs(a[1] - b[1]) <= 2 && std::abs(a[2] - b[2]) <= 2;
}

struct Halves {
  int green_left = 0, red_right = 0, crossed = 0;
};

// How many pixels of the screen's two colours are on their side of the other, and how many are not.
Halves count(const render::Image8& screen) {
  Halves halves;
  int first_red = screen.width;
  int last_green = -1;
  for (int y = 0; y < screen.height; ++y) {
    for (int x = 0; x < screen.width; ++x) {
      if (is_near(pixel(screen, x, y), {0, kHalf, 0})) {
        ++halves.green_left;
        last_green = std::max(last_green, x);
      } else if (is_near(pixel(screen, x, y), {kHalf, 0, 0})) {
        ++halves.red_right;
        first_red = std::min(first_red, x);
      }
    }
  }
  halves.crossed = first_red <= last_green ? 1 : 0;
  return halves;
}

TEST(SubmittedPixels, BothEyesAreOnTheCompositorsScreen) {
  const support::XScreen screen;
  const support::Monado monado({.visible = true});
  HeadsetProgram program({.size = std::array{64, 64}});
  TwoColours picture(program);
  const auto stop = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  Halves seen;
  while (std::chrono::steady_clock::now() < stop && (seen.green_left < 10'000 || seen.red_right < 10'000)) {
    for (int i = 0; i < 5; ++i) {  // some go by before the window shows the first
      const auto frame = program.next_visible();
      ASSERT_TRUE(frame);
      picture.show(program, *frame, [](const auto&) {});
    }
    seen = count(screen.screenshot());
  }
  // Each eye's half of the window is 192x216 or more, most of it inside the lens's circle.
  EXPECT_GE(seen.green_left, 10'000) << monado.said();
  EXPECT_GE(seen.red_right, 10'000);
  EXPECT_EQ(seen.crossed, 0) << "the left eye's picture is not left of the right eye's";
  program.leave();
}

}  // namespace
