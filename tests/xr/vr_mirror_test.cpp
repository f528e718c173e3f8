// `vergence vr --mirror` on a real runtime and a real X server.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>

#include "render/image/png.hpp"
#include "tests/support/monado.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/x_window.hpp"

namespace {

using nlohmann::json;
using support::ProgramResult;
using support::XWindow;

constexpr const char* kTitle = "Vergence: what the headset shows";
constexpr std::chrono::seconds kLimit{300};  // a loaded machine draws a frame of lavapipe's in seconds

ProgramResult vergence(std::vector<std::string> arguments) {
  return support::run_program({.arguments = std::move(arguments), .time_limit = kLimit});
}

std::future<ProgramResult> start(std::vector<std::string> arguments) {
  return std::async(std::launch::async, vergence, std::move(arguments));
}

bool is_running(const std::future<ProgramResult>& program) {
  return program.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready;
}

// A head and eyes that stand still for as long as a test takes.
std::string still_head() {
  std::ostringstream text;
  text << "time_s,head_px,head_py,head_pz,head_qx,head_qy,head_qz,head_qw,left_gx,left_gy,left_gz,right_gx,right_gy,"
          "right_gz,gaze_valid\n";
  for (int i = 0; i < 20'000; ++i) {  // at the 20 Hz of the compositor that shows nothing
    text << 0.05 * i << ",0,1.3,0,0,0,0,1,0,0,-1,0,0,-1,1\n";
  }
  return text.str();
}

// Shown, and no longer black.
bool has_picture(const XWindow& window) {
  const render::Image8 now = window.is_visible() ? window.screenshot() : render::Image8{};
  return std::ranges::count(now.rgb, 0) < static_cast<std::ptrdiff_t>(now.rgb.size() / 2);
}

void wait_for_picture(const XWindow& window, const std::future<ProgramResult>& program) {
  while (is_running(program) && !has_picture(window)) {
  }
}

// The window holds, byte for byte, what both eyes are shown, side by side, and Q ends the session in order.
TEST(VrMirror, ShowsWhatBothEyesAreShown) {
  const support::TemporaryFolder folder;
  const std::string last = (folder.path() / "last.png").string();
  const std::string head = folder.write("head.csv", still_head());
  const support::XScreen screen;
  const support::Monado monado;
  auto program = start(
      {"vr", "--mirror", "--replay", head, "--size", "96x80", "--mode", "pinhole", "--screenshot", last, "--json"});
  const XWindow window(screen, kTitle);
  wait_for_picture(window, program);
  render::Image8 seen;
  bool is_still = false;
  while (!is_still && is_running(program)) {
    const render::Image8 now = window.screenshot();
    is_still = now.rgb == seen.rgb;
    seen = now;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  window.press('q');
  const ProgramResult result = program.get();
  ASSERT_EQ(result.exit_status, 0) << result.err << monado.said();
  const render::Image8 shown = render::read_png(last);
  ASSERT_EQ(seen.width, 2 * 96);
  ASSERT_EQ(seen.height, 80);
  EXPECT_EQ(seen.rgb, shown.rgb);
  EXPECT_GT(json::parse(result.out)["frames_shown"], 0);
}

// What was pressed in the window is in the recording as soon as it has come about.
TEST(VrMirror, KeysReachTheSessionAndClosingTheWindowEndsIt) {
  const support::TemporaryFolder folder;
  const std::string trace = (folder.path() / "a.csv").string();
  const support::XScreen screen;
  const support::Monado monado;
  auto program = start({"vr", "--mirror", "--size", "32x32", "--mode", "pinhole", "--record", trace, "--json"});
  const XWindow window(screen, kTitle);
  wait_for_picture(window, program);
  window.press('r');
  window.press('m');
  const auto events = [&] {
    std::ifstream file(trace + ".json");
    const json record = json::parse(file, nullptr, false);  // it may be gone or in the making
    std::vector<std::string> names;
    for (const json& event : record.is_object() ? record["events"] : json::array()) {
      names.push_back(event["event"]);
    }
    return names;
  };
  while (is_running(program) && events().size() < 2) {
  }
  window.ask_to_close();
  const ProgramResult result = program.get();
  EXPECT_EQ(result.exit_status, 0) << result.err << monado.said();
  EXPECT_EQ(events(), (std::vector<std::string>{"recentred", "map"}));
  EXPECT_GT(json::parse(result.out)["frames_shown"], 0);
}

// The headset gets its frames whatever becomes of the window.
TEST(VrMirror, GoesOnWhileNobodyCanSeeTheWindow) {
  const support::XScreen screen;
  const support::Monado monado;
  auto program = start({"vr", "--mirror", "--size", "32x32", "--mode", "pinhole", "--frames", "40", "--json"});
  const XWindow window(screen, kTitle);
  wait_for_picture(window, program);
  window.resize(7, 700);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // some of the frames at this size
  window.unmap();
  const ProgramResult result = program.get();
  ASSERT_EQ(result.exit_status, 0) << result.err << monado.said();
  EXPECT_EQ(json::parse(result.out)["frames_shown"], 40);
}

TEST(VrMirror, SaysThatThereIsNoDisplayBeforeTheHeadsetIsAsked) {
  ::unsetenv("DISPLAY");
  ::setenv("XR_RUNTIME_JSON", "/nonexistent/runtime.json", 1);
  const ProgramResult result = vergence({"vr", "--mirror", "--frames", "1"});
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  EXPECT_EQ(result.err.find("vergence: --mirror: "), 0U) << result.err;
  EXPECT_NE(result.err.find("DISPLAY"), std::string::npos) << result.err;
}

}  // namespace
