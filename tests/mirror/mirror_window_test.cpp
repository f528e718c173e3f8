// The mirror's window beside a session that is only played: pictures come up in it, keys and closing come out of it.
#include "app/vr/mirror_window.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <functional>
#include <thread>

#include "app/vr/stop_signal.hpp"
#include "tests/support/x_window.hpp"

namespace {

constexpr const char* kTitle = "Vergence: what the headset shows";
constexpr int kWidth = 64, kHeight = 24;
constexpr std::uint32_t kLeft = 0xff00bc00U, kRight = 0xff0000bcU;  // green and red of 188

bool until(const std::function<bool()>& is_so) {
  const auto stop = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < stop) {
    if (is_so()) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

render::MirrorPicture two_colours() {
  render::MirrorPicture picture{kWidth, kHeight, {}};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    picture.pixels.push_back(i % kWidth < kWidth / 2 ? kLeft : kRight);
  }
  return picture;
}

bool shows_two_colours(const render::Image8& image) {
  for (int i = 0; i < image.width * image.height; ++i) {
    const bool left = i % image.width < image.width / 2;
    const std::array<int, 3> wanted = left ? std::array{0, 188, 0} : std::array{188, 0, 0};
    for (std::size_t c = 0; c < 3; ++c) {
      if (image.rgb[3 * static_cast<std::size_t>(i) + c] != wanted[c]) {
        return false;
      }
    }
  }
  return image.width == kWidth && image.height == kHeight;
}

class MirrorWindowOnScreen : public testing::Test {
 protected:
  support::XScreen screen;
  app::StopOnSignal signals;
  app::MirrorWindow mirror;
};

TEST_F(MirrorWindowOnScreen, ShowsWhatTheSessionPuts) {
  mirror.run_beside([&](app::MirrorLink& link) {
    EXPECT_EQ(link.room(), (std::array{0, 0})) << "nothing is expected yet";
    link.expect(kWidth, kHeight);
    const support::XWindow seen(screen, kTitle);
    EXPECT_TRUE(until([&] { return link.room() == std::array{kWidth, kHeight}; }));
    render::MirrorPicture picture = two_colours();
    link.put(picture);
    EXPECT_TRUE(until([&] { return shows_two_colours(seen.screenshot()); }));
    // What was covered or unmapped comes back by itself, without another picture.
    seen.unmap();
    EXPECT_TRUE(until([&] { return link.room() == std::array{0, 0}; }));
    seen.map();
    EXPECT_TRUE(until([&] { return seen.is_visible() && shows_two_colours(seen.screenshot()); }));
  });
  EXPECT_FALSE(app::StopOnSignal::wanted());
}

TEST_F(MirrorWindowOnScreen, EveryControlHasAKey) {
  mirror.run_beside([&](app::MirrorLink& link) {
    link.expect(kWidth, kHeight);
    const support::XWindow seen(screen, kTitle);
    for (const xcb_keysym_t key :
         {support::XWindow::kSpace, xcb_keysym_t{'n'}, xcb_keysym_t{'c'}, xcb_keysym_t{'m'}, xcb_keysym_t{'x'},
          xcb_keysym_t{'t'}, xcb_keysym_t{'r'}, support::XWindow::kEscape}) {
      seen.press(key);
    }
    std::vector<xr::Control> pressed;
    EXPECT_TRUE(until([&] {
      const auto more = link.pressed();
      pressed.insert(pressed.end(), more.begin(), more.end());
      return pressed.size() >= xr::kControls.size();
    }));
    EXPECT_EQ(pressed, std::vector(xr::kControls.begin(), xr::kControls.end()));
  });
  EXPECT_FALSE(app::StopOnSignal::wanted());
}

TEST_F(MirrorWindowOnScreen, ClosingEndsTheSession) {
  mirror.run_beside([&](app::MirrorLink& link) {
    link.expect(kWidth, kHeight);
    const support::XWindow seen(screen, kTitle);
    seen.ask_to_close();
    EXPECT_TRUE(until([] { return app::StopOnSignal::wanted(); }));
    EXPECT_TRUE(until([&] { return !seen.is_visible(); })) << "while the session comes to its end";
  });
}

TEST_F(MirrorWindowOnScreen, QEndsTheSession) {
  mirror.run_beside([&](app::MirrorLink& link) {
    link.expect(kWidth, kHeight);
    support::XWindow(screen, kTitle).press('q');
    EXPECT_TRUE(until([] { return app::StopOnSignal::wanted(); }));
    EXPECT_TRUE(link.pressed().empty());
  });
}

TEST_F(MirrorWindowOnScreen, WhatTheSessionThrowsComesOut) {
  EXPECT_THROW(mirror.run_beside([](app::MirrorLink&) { throw std::out_of_range("the session's own"); }),
               std::out_of_range);
}

}  // namespace
