// Words before the head: on the compositor's screen in both eyes, over the picture, until there are others.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "app/vr/text_panel.hpp"
#include "tests/support/headset_picture.hpp"
#include "tests/support/lit_scene.hpp"
#include "tests/support/monado.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/tiny_scene.hpp"
#include "tests/support/x_screen.hpp"
#include "xr/convert.hpp"

namespace {

using app::PlateLine;
using support::HeadsetProgram;
using tracking::Side;

constexpr int kWindowWidth = 640, kWindowHeight = 360;  // Monado's window of its simulated headset
constexpr int kGrey = 188;                              // sRGB of linear 0.5: the wall that the words are before

app::PlateConfig fonts() {
  app::PlateConfig config;
  config.font = VERGENCE_BUILT_ASSETS "/fonts/LiberationSans-Regular.ttf";
  config.bold_font = VERGENCE_BUILT_ASSETS "/fonts/LiberationSans-Bold.ttf";
  return config;
}

// Both eyes before a grey wall, words over it.
struct GreyWall {
  explicit GreyWall(HeadsetProgram& program)
      : picture(program, wall()), text(program.device, program.session, program.loop.view_space(), fonts()) {}

  static render::Scene wall() {
    render::Scene scene = support::dark_scene();
    support::add_wall(scene, support::add_material(scene, support::unlit({0.5F, 0.5F, 0.5F, 1})), 0.0F, 0.0F, 2.0F,
                      4.0F);
    return scene;
  }

  void show(HeadsetProgram& program, const xr::Frame& frame) {
    (void)picture.start(program);
    program.loop.show(frame, std::array{&text.panel()});
  }

  support::HeadsetPicture picture;
  app::TextPanel text;
};

std::array<tracking::EyeView, 2> views_of(const xr::Frame& frame) {
  std::array<tracking::EyeView, 2> views;
  for (std::size_t i = 0; i < 2; ++i) {
    views[i] = {.head_from_view = frame.views[i].head_from_view, .fov = frame.views[i].fov};
  }
  return views;
}

constexpr app::TextPanelConfig kNear{.distance = 0.5, .letter_angle = 0.03};
const std::vector<PlateLine> kShort{{"Pair", "bifocal"}};
const std::vector<PlateLine> kLong{{"Pair", "progressive, Größe 2"},
                                   {"Gaze", "from the eye tracker"},
                                   {"Warning", "the prisms differ", PlateLine::Kind::warning}};

struct Box {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;  // px

  void add(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
};

// Where one eye sees the panel, in its half of a window whose left half begins at x = 0.
Box expected_box(const app::TextPanel& text, const xr::HeadsetView& view, double half_width, double height) {
  const XrCompositionLayerQuad quad = text.panel().layer();
  const tracking::Pose head_from_panel = xr::pose_of(quad.pose);
  Box box;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const glm::dvec3 p = view.head_from_view.inverse().point(head_from_panel.point(
          {x * static_cast<double>(quad.size.width), y * static_cast<double>(quad.size.height), 0}));
      box.add((p.x / -p.z + view.fov.tan_left) / (view.fov.tan_left + view.fov.tan_right) * half_width,
              (view.fov.tan_up - p.y / -p.z) / (view.fov.tan_up + view.fov.tan_down) * height);
    }
  }
  return box;
}

struct Seen {
  Box plate;                  // in its half
  int bright = 0;             // pixels of letters, on the plate and brighter than the wall
  int amber = 0;              // of a warning's
  int stray = 0;              // neither wall nor within the plate
  int width = 0, height = 0;  // of a half
};

// One half of the compositor's window, which stands in the screen's corner; Monado shades its rim.
Seen look(const render::Image8& screen, Side side) {
  constexpr int kRim = 6;
  const auto at = [&](int x, int y) { return screen.rgb.data() + 3 * (y * screen.width + x); };
  Seen seen;
  while (seen.width < screen.width && at(seen.width, kRim)[0] > 0) {
    ++seen.width;
  }
  while (seen.height < screen.height && at(kRim, seen.height)[0] > 0) {
    ++seen.height;
  }
  seen.width /= 2;
  const int first = side == Side::left ? 0 : seen.width;
  const auto each = [&](auto&& f) {
    for (int y = kRim; y < seen.height - kRim; ++y) {
      for (int x = kRim; x < seen.width - kRim; ++x) {
        f(x, y, at(first + x, y));
      }
    }
  };
  each([&](int x, int y, const std::uint8_t* p) {
    if (p[1] < 120 && p[0] < 150) {  // the plate leaves a tenth of the wall's light, sRGB 65
      seen.plate.add(x, y);
    }
  });
  const Box& plate = seen.plate;
  each([&](int x, int y, const std::uint8_t* p) {
    seen.bright += p[1] > kGrey + 15 ? 1 : 0;
    seen.amber += p[0] > p[2] + 60 ? 1 : 0;
    const bool outside = x < plate.left - 2 || x > plate.right + 2 || y < plate.top - 2 || y > plate.bottom + 2;
    seen.stray += outside && std::abs(p[0] - kGrey) > 3 ? 1 : 0;
  });
  return seen;
}

// What both halves show, once `enough` says so of the left one; frames go on meanwhile.
template <class Enough>
std::array<Seen, 2> wait_for(HeadsetProgram& program, GreyWall& wall, const support::XScreen& screen, Enough&& enough) {
  const auto stop = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  std::array<Seen, 2> seen;
  do {
    for (int i = 0; i < 5; ++i) {  // some go by before the window shows the first
      if (const auto frame = program.next_visible()) {
        wall.show(program, *frame);
      }
    }
    const render::Image8 picture = screen.screenshot();
    for (const Side side : {Side::right, Side::left}) {
      seen[static_cast<std::size_t>(side)] = look(picture, side);
    }
  } while (!enough(seen[1]) && std::chrono::steady_clock::now() < stop);
  return seen;
}

void expect_plates(const std::array<Seen, 2>& seen, const GreyWall& wall, const xr::Frame& frame) {
  for (const Side side : {Side::right, Side::left}) {
    const auto i = static_cast<std::size_t>(side);
    const Seen& s = seen[i];
    SCOPED_TRACE(side == Side::right ? "right eye" : "left eye");
    const Box box = expected_box(wall.text, frame.views[i], s.width, s.height);
    // The window is drawn through images of 192x216, whose pixels are up to 1.7 of its own; the plate's corners are
    // round, and a pixel of its edge counts as wall when it is less than half covered.
    constexpr double kPixels = 5.0;
    EXPECT_NEAR(s.plate.left, box.left, kPixels);
    EXPECT_NEAR(s.plate.right, box.right, kPixels);
    EXPECT_NEAR(s.plate.top, box.top, kPixels);
    EXPECT_NEAR(s.plate.bottom, box.bottom, kPixels);
    EXPECT_GT(s.bright, 20) << "no bright letters";
    EXPECT_EQ(s.stray, 0) << "something but the plate lies over the picture";
  }
  // Nearer than the eyes' parallel lines: farther right for the left eye. 64 mm at 0.5 m are some 20 pixels.
  EXPECT_GT(seen[1].plate.left, seen[0].plate.left + 10);
}

TEST(TextPanel, HangsBeforeBothEyesAtItsDistanceAndChangesWithItsText) {
  const support::XScreen screen;
  const support::Monado monado({.visible = true});
  HeadsetProgram program({.size = std::array{64, 64}});
  GreyWall wall(program);
  const auto frame = program.next_visible();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(wall.text.panel().is_empty());
  wall.show(program, *frame);  // nothing written yet: the picture alone
  wall.text.write(kShort, views_of(*frame), kNear);
  const auto first = wait_for(program, wall, screen, [](const Seen& s) { return s.bright > 20; });
  expect_plates(first, wall, *frame);
  EXPECT_EQ(first[0].amber + first[1].amber, 0);

  wall.text.write(kLong, views_of(*frame), kNear);
  const auto second = wait_for(program, wall, screen, [](const Seen& s) { return s.amber > 20; });
  expect_plates(second, wall, *frame);
  EXPECT_GT(second[0].amber, 20);
  EXPECT_GT(second[1].amber, 20);

  wall.text.write(kShort, views_of(*frame), kNear);
  const auto third = wait_for(program, wall, screen, [](const Seen& s) { return s.amber == 0; });
  expect_plates(third, wall, *frame);
  EXPECT_EQ(third[0].amber + third[1].amber, 0) << "the longer text is still there";
  program.leave();
}

// A text a frame is more than ever comes, and must not wait on images or break a rule.
TEST(TextPanel, ValidationLayersHaveNothingToSay) {
  const support::Monado monado;
  const std::string log = (monado.folder() / "openxr.txt").string();
  ::setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation", 1);
  ::setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
  ::setenv("XR_CORE_VALIDATION_FILE_NAME", log.c_str(), 1);
  std::ostringstream text;
  std::vector<std::string> said;
  {
    // STAGE: the layer of OpenXR 1.0.20 is older than LOCAL_FLOOR and refuses its number.
    HeadsetProgram program({.space = xr::SpaceChoice::stage, .size = std::array{40, 40}}, true);
    GreyWall wall(program);
    for (int i = 0; i < 8; ++i) {
      const auto frame = program.next_visible();
      ASSERT_TRUE(frame);
      if (i > 0 && i < 6) {
        wall.text.write(i % 2 == 0 ? kShort : kLong, views_of(*frame), kNear);
      }
      wall.show(program, *frame);
    }
    (void)wall.picture.live->wait();
    text << std::ifstream(log).rdbuf();
    program.leave();
    said = program.device.validation_messages();
  }
  ::unsetenv("XR_ENABLE_API_LAYERS");
  EXPECT_EQ(said, std::vector<std::string>{});
  EXPECT_EQ(text.str(), "");
}

// How many pixels of letters are on the screen's left and right half of the window while the program runs over a black
// scene.
std::array<int, 2> letters_of_program(const support::XScreen& screen, std::vector<std::string> more) {
  const support::TemporaryFolder folder;
  const std::string scene =
      folder.write("dark.gltf", support::patch_gltf({support::wall(2.0F, 3.0F, 0.0F)}, {}).text());
  std::vector<std::string> arguments{"vr", "--scene", scene, "--mode", "pinhole", "--size", "32x32", "--frames", "25"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  std::array<int, 2> most{};
  std::atomic<bool> is_running = true;
  std::thread program([&] {
    const auto result =
        support::run_program({.arguments = std::move(arguments), .time_limit = std::chrono::seconds(120)});
    EXPECT_EQ(result.exit_status, 0) << result.err;
    is_running = false;
  });
  while (is_running) {
    const render::Image8 picture = screen.screenshot();
    std::array<int, 2> bright{};
    for (int y = 0; y < kWindowHeight; ++y) {
      for (int x = 0; x < kWindowWidth; ++x) {
        bright[x < kWindowWidth / 2 ? 0 : 1] += picture.rgb[3 * (y * picture.width + x) + 1] > 150 ? 1 : 0;
      }
    }
    most = {std::max(most[0], bright[0]), std::max(most[1], bright[1])};
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  program.join();
  return most;
}

TEST(TextPanel, TheProgramWritesInBothEyesUnlessToldNotTo) {
  const support::XScreen screen;
  const support::Monado monado({.visible = true});
  // In this order: a window may keep what it showed last.
  const auto without = letters_of_program(screen, {"--no-text"});
  EXPECT_EQ(without[0] + without[1], 0);
  const auto with = letters_of_program(screen, {});
  EXPECT_GT(with[0], 100) << monado.said();
  EXPECT_GT(with[1], 100);
}

}  // namespace
