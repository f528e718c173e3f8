// `vergence vr` on a real runtime, and without one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <future>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>

#include "render/image/png.hpp"
#include "tests/support/monado.hpp"
#include "tests/support/remote_head.hpp"
#include "tests/support/run_program.hpp"
#include "tracking/gaze_trace.hpp"
#include "tracking/stereo_view.hpp"

namespace {

using nlohmann::json;
using support::ProgramResult;
using support::RemoteHead;

constexpr std::chrono::seconds kLimit{300};  // a loaded machine draws a frame of lavapipe's in seconds

ProgramResult vergence(std::vector<std::string> arguments) {
  return support::run_program({.arguments = std::move(arguments), .time_limit = kLimit});
}

// The runtime's library writes to standard error too; of ours there is one line.
std::string our_line(const ProgramResult& result) {
  const std::size_t at = result.err.find("vergence: ");
  EXPECT_NE(at, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("vergence: ", at + 1), std::string::npos) << result.err;
  return at == std::string::npos ? "" : result.err.substr(at, result.err.find('\n', at) - at);
}

TEST(VrCommand, ShowsFramesOnARuntime) {
  const support::Monado monado;
  const ProgramResult result = vergence({"vr", "--frames", "4", "--size", "48x48", "--json"});
  ASSERT_EQ(result.exit_status, 0) << result.err << monado.said();
  const json report = json::parse(result.out);
  EXPECT_EQ(report["frames_shown"], 4);
  EXPECT_EQ(report["size"], "48x48");
  EXPECT_EQ(report["space"], "local_floor");
  EXPECT_EQ(report["gaze_frames"]["head"], 4);
  EXPECT_GT(report["stages_ms"]["trace"]["median"], 0.0);
  EXPECT_GT(report["wait_to_submit_ms"]["median"], 0.0);
  EXPECT_GT(report["frame_code_cpu_ms"]["median"], 0.0);
  EXPECT_GE(report["head_speed_deg_s"]["max"], 0.0);  // 0 where frames take longer than a speed is told from
  EXPECT_EQ(report["reprojection_error_arcmin"]["max"], 0.0) << "no lens is worn";
}

TEST(VrCommand, SaysHowToStartARuntimeThatIsNotThere) {
  ::setenv("XR_RUNTIME_JSON", "/nonexistent/runtime.json", 1);
  const ProgramResult result = vergence({"vr", "--frames", "1"});
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(result.out, "");
  const std::string line = our_line(result);
  EXPECT_EQ(result.err, line + "\n");
  EXPECT_NE(line.find("XR_RUNTIME_JSON"), std::string::npos) << line;
  EXPECT_NE(line.find("start one"), std::string::npos) << line;
}

TEST(VrCommand, SaysHowToStartARuntimeThatDoesNotAnswer) {
  support::Monado monado;
  monado.kill();
  const ProgramResult result = vergence({"vr", "--frames", "1"});
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_NE(our_line(result).find("start one"), std::string::npos) << result.err;
}

TEST(VrCommand, BadInputIsSaidBeforeTheHeadsetIsAsked) {
  ::setenv("XR_RUNTIME_JSON", "/nonexistent/runtime.json", 1);
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"--size", "48"},
                                              {"--frames", "0"},
                                              {"--range", "3,1", "--mode", "power"},
                                              {"--wearer", "/nonexistent.json"},
                                              {"--screenshot", "picture.jpg"},
                                              {"--space", "floor"},
                                              {"--fov", "60"},
                                              {"--samples", "0"},
                                              {"--pose", "1,2"}}) {
    std::vector<std::string> arguments{"vr"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    const ProgramResult result = vergence(arguments);
    EXPECT_EQ(result.exit_status, 2) << bad[0] << ": " << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  }
}

// Whenever the runtime dies, the command ends by itself, with one line and without a torn picture.
TEST(VrCommand, EndsWhenTheRuntimeIsKilled) {
  for (const int delay_ms : {100, 1000, 4000}) {
    support::Monado monado;
    const support::TemporaryFolder folder;
    std::thread killer([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
      monado.kill();
    });
    const ProgramResult result = vergence({"vr", "--size", "32x32", "--frames", "1000000", "--reconnect", "0",
                                           "--screenshot", (folder.path() / "last.png").string()});
    killer.join();
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.signal, 0);
    EXPECT_EQ(result.exit_status, 1) << result.err;
    EXPECT_NE(our_line(result).find("openxr"), std::string::npos);
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
  }
}

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// A recording draws the same pictures again, bit for bit, wherever the head is by then.
TEST(VrCommand, AReplayIsThePictureThatWasRecorded) {
  const support::TemporaryFolder folder;
  const auto file = [&](const char* name) { return (folder.path() / name).string(); };
  const std::vector<std::string> worn{"--spectacles", VERGENCE_ASSETS "/spectacles/hyperopia.json", "--wearer",
                                      VERGENCE_ASSETS "/wearers/hyperopia.json"};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), worn.begin(), worn.end());
    const ProgramResult result = vergence(arguments);
    ASSERT_EQ(result.exit_status, 0) << result.err;
  };
  const support::Monado monado;  // its simulated head never stands still
  run({"vr", "--size", "48x40", "--frames", "6", "--record", file("a.csv"), "--screenshot", file("recorded.png")});
  run({"vr", "--replay", file("a.csv"), "--screenshot", file("replayed.png")});
  run({"vr", "--size", "48x40", "--frames", "6", "--screenshot", file("elsewhere.png")});
  EXPECT_EQ(content_of(file("replayed.png")), content_of(file("recorded.png")));
  EXPECT_NE(content_of(file("elsewhere.png")), content_of(file("recorded.png"))) << "the head stood still";
  EXPECT_EQ(tracking::read_gaze_trace(file("a.csv")).rows.size(), 6U);
}

// Until a recording has its header and three frames.
void wait_for_rows(const std::filesystem::path& trace) {
  const auto stop = std::chrono::steady_clock::now() + kLimit;
  const auto lines = [&] {
    const std::string text = content_of(trace);
    return std::ranges::count(text, '\n');
  };
  while (lines() < 4 && std::chrono::steady_clock::now() < stop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

// What was recorded before the runtime died is whole, and says how it ended.
TEST(VrCommand, ARecordingOutlivesTheRuntime) {
  support::Monado monado;
  const support::TemporaryFolder folder;
  const std::filesystem::path trace = folder.path() / "a.csv";
  std::thread killer([&] {
    wait_for_rows(trace);
    monado.kill();
  });
  const ProgramResult result =
      vergence({"vr", "--size", "32x32", "--frames", "1000000", "--reconnect", "0.5", "--record", trace.string()});
  killer.join();
  EXPECT_EQ(result.exit_status, 1) << result.err;
  EXPECT_FALSE(result.timed_out);
  const tracking::GazeTrace kept = tracking::read_gaze_trace(trace.string());
  EXPECT_GE(kept.rows.size(), 3U);
  EXPECT_FALSE(kept.last_line_cut);
  const json record = json::parse(content_of(trace.string() + ".json"));
  EXPECT_EQ(record["events"].back()["event"], "session lost");
}

// A runtime that is started again gets the session back, and the recording goes on where it stopped.
TEST(VrCommand, GoesOnWithARuntimeThatIsStartedAgain) {
  support::Monado monado;
  const support::TemporaryFolder folder;
  const std::filesystem::path trace = folder.path() / "a.csv";
  // The service lives as long as the thread that started it, so that is this one.
  auto session = std::async(std::launch::async, [&] {
    return vergence(
        {"vr", "--size", "32x32", "--frames", "16", "--reconnect", "120", "--record", trace.string(), "--json"});
  });
  wait_for_rows(trace);
  monado.kill();
  std::this_thread::sleep_for(std::chrono::milliseconds(700));  // gone for a try
  monado.start();
  const ProgramResult result = session.get();
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const json report = json::parse(result.out);
  EXPECT_EQ(report["frames_shown"], 16);
  EXPECT_EQ(report["reconnections"], 1);
  const tracking::GazeTrace kept = tracking::read_gaze_trace(trace.string());
  // All that were shown, and the one that was under way when the runtime died.
  ASSERT_GE(kept.rows.size(), 16U);
  ASSERT_LE(kept.rows.size(), 17U);
  for (std::size_t i = 1; i < kept.rows.size(); ++i) {
    EXPECT_LT(kept.rows[i - 1].time, kept.rows[i].time);
  }
  const json record = json::parse(content_of(trace.string() + ".json"));
  std::vector<std::string> events;
  for (const json& event : record["events"]) {
    events.push_back(event["event"]);
  }
  EXPECT_EQ(events, (std::vector<std::string>{"session lost", "runtime returned"}));
}

// A headset whose displays are turned to where `render` turns its pictures shows what render draws for those eyes.
TEST(VrCommand, EachEyeSeesThroughItsOwnLensAsRenderDrawsIt) {
  support::leave_network();
  const support::TemporaryFolder folder;
  // Without accommodation, so that none of its course in time comes in between.
  const std::string wearer = folder.write("wearer.json",
                                          R"({"right": {"accommodation_amplitude_D": 0.0},
                                              "left": {"accommodation_amplitude_D": 0.0}})");
  const std::string plano_and_four =
      folder.write("pair.json",
                   R"({"right": {"prescription": {"sphere": 0.0, "cylinder": 0, "axis": 0}, "material": "CR-39"},
          "left": {"prescription": {"sphere": 4.0, "cylinder": 0, "axis": 0}, "material": "CR-39"}})");
  const std::string drawn = (folder.path() / "render.png").string();
  const std::string shown = (folder.path() / "vr.png").string();
  const std::vector<std::string> shared{"--spectacles", plano_and_four, "--wearer",
                                        wearer,         "--headset",    VERGENCE_ASSETS "/headsets/example.json",
                                        "--size",       "160x160"};
  std::vector<std::string> render{"render", "--fov", "60", "--pose", "0.2,1.3,0.1,0,0", "--output", drawn, "--json"};
  render.insert(render.end(), shared.begin(), shared.end());
  const ProgramResult still = vergence(render);
  ASSERT_EQ(still.exit_status, 0) << still.err;

  const support::Monado monado({.remote = true});
  support::RemoteHub hub;
  RemoteHead head;
  head.head.position = {0.2F, 1.3F, 0.1F};
  const json sight = json::parse(still.out)["sight"];
  for (const json& eye : sight) {
    const bool left = eye["eye"] == "left";
    RemoteHead::View& view = head.view[left ? 0 : 1];
    const double yaw = eye["gaze_deg"][0].get<double>() * M_PI / 180.0;
    const double pitch = eye["gaze_deg"][1].get<double>() * M_PI / 180.0;
    const glm::dquat turn = glm::quat_cast(tracking::listing_rotation(tracking::direction_from_yaw_pitch(yaw, pitch)));
    view.head_from_view = {{static_cast<float>(turn.x), static_cast<float>(turn.y), static_cast<float>(turn.z),
                            static_cast<float>(turn.w)},
                           {left ? -0.0315F : 0.0315F, 0.0F, 0.0F}};
    const auto half = static_cast<float>(M_PI / 6.0);
    view.fov = {-half, half, half, -half};
  }
  hub.tell(head);
  std::vector<std::string> live{"vr",       "--space", "stage",        "--pose", "0,0,0,0,0",
                                "--frames", "2",       "--screenshot", shown,    "--json"};
  live.insert(live.end(), shared.begin(), shared.end());
  const ProgramResult session = vergence(live);
  ASSERT_EQ(session.exit_status, 0) << session.err;
  const int guard = json::parse(session.out)["guard_px"];
  EXPECT_GT(guard, 0);

  // Left and right, without the border where render has nothing beyond it to blur in.
  const auto inside = [&](const render::Image8& image, int eye) {
    const int side = 160 - 2 * guard;
    render::Image8 part = render::black_image(side, side);
    for (int y = 0; y < side; ++y) {
      const auto from = 3 * static_cast<std::ptrdiff_t>((y + guard) * image.width + eye * 160 + guard);
      std::copy_n(image.rgb.begin() + from, 3 * side, part.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(y * side));
    }
    return part;
  };
  const render::Image8 expected = render::read_png(drawn);
  const render::Image8 seen = render::read_png(shown);
  ASSERT_EQ(seen.width, 320);
  for (const int eye : {0, 1}) {
    EXPECT_GE(render::compare(inside(seen, eye), inside(expected, eye)).psnr_db, 45.0) << (eye == 0 ? "left" : "right");
  }
  // The two lenses do differ.
  EXPECT_LT(render::compare(inside(seen, 0), inside(seen, 1)).psnr_db, 30.0);
}

}  // namespace
