// The window and the pictures in it, on a real X server and whatever device is there, with validation on throughout.
#include "app/window/window.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>

#include "render/vk/window_pictures.hpp"
#include "tests/support/x_window.hpp"

namespace {

using render::Image8;
using render::vk::Buffer;
using render::vk::PixelBlock;
using Colour = std::array<int, 3>;

constexpr const char* kTitle = "a window of the test";
constexpr int kWidth = 60, kHeight = 30;
constexpr Colour kLeft{0, 188, 3}, kRight{201, 0, 77}, kBlack{0, 0, 0};

struct Pixels {
  explicit Pixels(const render::vk::Device& device) : buffer(device, 4 * kWidth * kHeight, render::vk::Memory::upload) {
    std::vector<std::uint32_t> words;
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const Colour& c = i % kWidth < kWidth / 2 ? kLeft : kRight;
      words.push_back(0xff000000U | static_cast<std::uint32_t>(c[0] | (c[1] << 8) | (c[2] << 16)));
    }
    buffer.write(words);
  }
  [[nodiscard]] PixelBlock block() const {
    return {.from = &buffer, .row_pixels = kWidth, .width = kWidth, .height = kHeight};
  }
  Buffer buffer;
};

class WindowOnScreen : public testing::Test {
 protected:
  // Turns the window's loop until `is_so`, a minute at most: on a loaded machine an X server takes its time.
  bool until(const std::function<bool()>& is_so) {
    const auto stop = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < stop) {
      window.poll(0.005);
      if (is_so()) {
        return true;
      }
    }
    return false;
  }

  void TearDown() override {
    for (const std::string& message : device.validation_messages()) {
      ADD_FAILURE() << message;
    }
  }

  static Colour at(const Image8& image, int x, int y) {
    const auto i = 3 * static_cast<std::size_t>(y * image.width + x);
    return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
  }

  support::XScreen screen;
  app::Window window{kTitle};
  render::vk::WindowBinding binding = window.binding();
  render::vk::Device device{{.validation = true, .window = &binding}};
};

TEST_F(WindowOnScreen, ShowsThePicturesOwnBytes) {
  render::vk::WindowPictures pictures(device);
  const Pixels pixels(device);
  window.fit(kWidth, kHeight);
  window.show();
  const support::XWindow seen(screen, kTitle);
  ASSERT_TRUE(until([&] { return window.size() == std::array{kWidth, kHeight}; }));
  const auto is_shown = [&] {
    (void)pictures.show({{pixels.block()}}, kWidth, kHeight, window.size());
    const Image8 now = seen.screenshot();
    return at(now, 0, 0) == kLeft && at(now, kWidth - 1, kHeight - 1) == kRight;
  };
  ASSERT_TRUE(until(is_shown));
  const Image8 now = seen.screenshot();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_EQ(at(now, x, y), x < kWidth / 2 ? kLeft : kRight) << x << ',' << y;
    }
  }
}

// As large as it fits, in the middle, black around it; whatever the window's user makes of its size.
TEST_F(WindowOnScreen, FollowsTheWindowsSize) {
  render::vk::WindowPictures pictures(device);
  const Pixels pixels(device);
  window.fit(kWidth, kHeight);
  window.show();
  const support::XWindow seen(screen, kTitle);
  for (const std::array<std::uint32_t, 2>& size :
       {std::array{120U, 120U}, std::array{200U, 40U}, std::array{17U, 31U}}) {
    seen.resize(size[0], size[1]);
    const auto width = static_cast<int>(size[0]);
    const auto height = static_cast<int>(size[1]);
    const bool is_tall = 2 * height > width;  // the picture is twice as wide as high
    const auto is_fitted = [&] {
      (void)pictures.show({{pixels.block()}}, kWidth, kHeight, window.size());
      const Image8 now = seen.screenshot();
      if (now.width != width || now.height != height) {
        return false;
      }
      const int left = is_tall ? 1 : (width - 2 * height) / 2 + 1;
      const int right = width - 1 - left;
      return at(now, left, height / 2) == kLeft && at(now, right, height / 2) == kRight &&
             at(now, is_tall ? width / 2 : 1, is_tall ? 1 : height / 2) == kBlack;
    };
    EXPECT_TRUE(until(is_fitted)) << width << 'x' << height;
  }
}

TEST_F(WindowOnScreen, ShowsNothingWhileNobodyCanSeeIt) {
  render::vk::WindowPictures pictures(device);
  const Pixels pixels(device);
  EXPECT_EQ(window.size(), (std::array{0, 0})) << "not shown yet";
  EXPECT_FALSE(pictures.show({{pixels.block()}}, kWidth, kHeight, {0, 0}));
  window.show();
  const support::XWindow seen(screen, kTitle);
  ASSERT_TRUE(until([&] { return window.size()[0] > 0; }));
  seen.unmap();
  ASSERT_TRUE(until([&] { return window.size() == std::array{0, 0}; }));
  // A window that went while the picture was on its way: nothing hangs, nothing is wrong.
  for (int i = 0; i < 10; ++i) {
    (void)pictures.show({{pixels.block()}}, kWidth, kHeight, {kWidth, kHeight});
  }
  seen.map();
  EXPECT_TRUE(
      until([&] { return window.size()[0] > 0 && pictures.show({{pixels.block()}}, kWidth, kHeight, window.size()); }));
  window.hide();
  EXPECT_TRUE(until([&] { return window.size() == std::array{0, 0} && !seen.is_visible(); }));
}

TEST_F(WindowOnScreen, TellsKeysOnce) {
  window.show();
  const support::XWindow seen(screen, kTitle);
  std::vector<std::string> keys;
  const std::vector<std::string> wanted{"n", "space", "escape", "q", "n"};
  for (const xcb_keysym_t key :
       {xcb_keysym_t{'n'}, support::XWindow::kSpace, support::XWindow::kEscape, xcb_keysym_t{'q'}, xcb_keysym_t{'n'}}) {
    seen.press(key);
  }
  EXPECT_TRUE(until([&] {
    const auto more = window.pressed();
    keys.insert(keys.end(), more.begin(), more.end());
    return keys.size() >= wanted.size();
  }));
  EXPECT_EQ(keys, wanted);
  window.poll();
  EXPECT_TRUE(window.pressed().empty());
}

TEST_F(WindowOnScreen, SaysWhenItIsToBeClosed) {
  window.show();
  const support::XWindow seen(screen, kTitle);
  window.poll();
  EXPECT_FALSE(window.close_wanted());
  seen.ask_to_close();
  EXPECT_TRUE(until([&] { return window.close_wanted(); }));
}

TEST(Window, SaysThatThereIsNoDisplay) {
  ::unsetenv("DISPLAY");
  try {
    const app::Window window(kTitle);
    FAIL() << "a window without a display";
  } catch (const app::WindowError& error) {
    EXPECT_NE(std::string(error.what()).find("DISPLAY"), std::string::npos) << error.what();
  }
}

}  // namespace
