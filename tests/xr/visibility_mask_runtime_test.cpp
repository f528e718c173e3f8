// What a real runtime hides of its views.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "render/image/png.hpp"
#include "tests/support/headset_program.hpp"
#include "tests/support/monado.hpp"
#include "tests/support/run_program.hpp"
#include "xr/visibility_mask.hpp"

namespace {

using support::HeadsetProgram;
using tracking::PixelMask;
using tracking::Side;

constexpr int kSide = 128;

// Monado hides the four corners of its simulated headset's displays.
TEST(VisibilityMaskOfARuntime, HidesCornersAndNotTheMiddle) {
  const support::Monado monado;
  HeadsetProgram program({.size = std::array{32, 32}}, false, {XR_KHR_VISIBILITY_MASK_EXTENSION_NAME});
  const auto frame = program.next_visible();
  ASSERT_TRUE(frame);
  xr::VisibilityMasks masks(program.session);
  EXPECT_TRUE(masks.is_offered());
  EXPECT_EQ(masks.changes(), 0);
  std::array<PixelMask, 2> pixels;
  for (const Side side : {Side::right, Side::left}) {
    const auto i = static_cast<std::size_t>(side);
    const xr::HiddenView& view = masks.view(side);
    EXPECT_EQ(view.problem, "");
    pixels[i] = tracking::hidden_pixels(view.area, frame->views[i].fov, kSide, kSide);
    EXPECT_GT(pixels[i].hidden_fraction(), 0.01);
    EXPECT_LT(pixels[i].hidden_fraction(), 0.5);
    for (const int x : {0, kSide - 1}) {
      for (const int y : {0, kSide - 1}) {
        EXPECT_TRUE(pixels[i].at(x, y)) << x << " " << y;
      }
    }
    for (int y = kSide / 4; y < 3 * kSide / 4; ++y) {
      for (int x = kSide / 4; x < 3 * kSide / 4; ++x) {
        ASSERT_FALSE(pixels[i].at(x, y)) << x << " " << y;
      }
    }
  }
  // The two eyes' displays are mirror images; a pixel on a triangle's very edge may round either way.
  int unlike = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      unlike += pixels[0].at(x, y) != pixels[1].at(kSide - 1 - x, y) ? 1 : 0;
    }
  }
  EXPECT_LE(unlike, 8);
  program.loop.skip(*frame);
  program.leave();
}

// Monado never announces a change by itself: the event is the test's.
TEST(VisibilityMaskOfARuntime, IsAskedForAgainWhenItIsSaidToHaveChanged) {
  const support::Monado monado;
  HeadsetProgram program({.size = std::array{32, 32}}, false, {XR_KHR_VISIBILITY_MASK_EXTENSION_NAME});
  xr::VisibilityMasks masks(program.session);
  const std::size_t triangles = masks.view(Side::left).area.triangles.size();
  XrEventDataBuffer buffer{};
  auto& event = reinterpret_cast<XrEventDataVisibilityMaskChangedKHR&>(buffer);
  event.type = XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR;
  event.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  masks.handle(buffer);
  EXPECT_EQ(masks.changes(), 0) << "another session's";
  event.session = program.session.handle();
  event.viewIndex = 7;
  masks.handle(buffer);
  EXPECT_EQ(masks.changes(), 0) << "no view of ours";
  event.viewIndex = 0;
  masks.handle(buffer);
  EXPECT_EQ(masks.changes(), 1);
  EXPECT_EQ(masks.view(Side::left).area.triangles.size(), triangles);
}

TEST(VisibilityMaskOfARuntime, WithoutTheExtensionHidesNothing) {
  const support::Monado monado;
  HeadsetProgram program({.size = std::array{32, 32}});
  const xr::VisibilityMasks masks(program.session);
  EXPECT_FALSE(masks.is_offered());
  EXPECT_TRUE(masks.view(Side::right).area.triangles.empty());
}

// `vr` leaves the corners black; without the mask the sky is in them, or the room.
TEST(VisibilityMaskOfARuntime, VrDrawsNoCorners) {
  const support::Monado monado;
  const support::TemporaryFolder folder;
  const std::string picture = (folder.path() / "vr.png").string();
  const support::ProgramResult result =
      support::run_program({.arguments = {"vr", "--frames", "2", "--size", "256x256", "--mode", "pinhole",
                                          "--screenshot", picture, "--json"},
                            .time_limit = std::chrono::seconds(300)});
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const auto report = nlohmann::json::parse(result.out);
  EXPECT_GT(report["hidden_fraction"], 0.01);
  EXPECT_LT(report["hidden_fraction"], 0.5);
  EXPECT_GT(report["left_out_fraction"], 0.0);
  EXPECT_LE(report["left_out_fraction"], report["hidden_fraction"]);
  EXPECT_EQ(report["mask_problem"], "");
  const render::Image8 seen = render::read_png(picture);
  const auto light = [&](int x, int y) {
    const auto at = 3 * static_cast<std::size_t>(y * seen.width + x);
    return seen.rgb[at] + seen.rgb[at + 1] + seen.rgb[at + 2];
  };
  for (const int eye : {0, 256}) {
    for (const int x : {0, 255}) {
      for (const int y : {0, 255}) {
        EXPECT_EQ(light(eye + x, y), 0) << eye + x << " " << y;
      }
    }
    EXPECT_GT(light(eye + 128, 128), 0);
    EXPECT_GT(light(eye + 128, 2), 0);
  }
}

}  // namespace
