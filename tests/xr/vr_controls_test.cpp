// What the wearer's hands ask for, from the button to the picture and back from a recording, on a real Monado.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/vr/run.hpp"
#include "render/image/png.hpp"
#include "render/scene/scene.hpp"
#include "tests/support/monado.hpp"
#include "tests/support/remote_head.hpp"
#include "tests/support/run_program.hpp"
#include "tracking/gaze_trace.hpp"
#include "tracking/input_error.hpp"

namespace {

using nlohmann::json;
using xr::Control;

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

app::VrOptions options_of(int frames) {
  app::VrOptions options;
  options.scene.spectacles = VERGENCE_ASSETS "/spectacles/hyperopia.json";
  options.scene.wearer = VERGENCE_ASSETS "/wearers/hyperopia.json";
  options.size = "48x40";
  options.frames = frames;
  return options;
}

// Keys pressed before certain frames, as a window would pass them on.
app::ControlSource keys(std::map<int, std::vector<Control>> script) {
  return [script = std::move(script), frame = -1]() mutable {
    const auto pressed = script.find(++frame);
    return pressed == script.end() ? std::vector<Control>{} : pressed->second;
  };
}

class VrControls : public testing::Test {
 protected:
  static void SetUpTestSuite() { support::leave_network(); }
  [[nodiscard]] std::string file(const char* name) const { return (folder_.path() / name).string(); }

 private:
  support::TemporaryFolder folder_;
};

// Each control has its effect from the very frame it was pressed before; nothing that it asks for is compiled while
// somebody looks on; and the recording, played again, ends in the same picture of two pairs, bit for bit.
TEST_F(VrControls, KeysChangeThePictureAndAReplayShowsItAgain) {
  const support::Monado monado;
  app::VrOptions live = options_of(14);
  live.scene.further = {VERGENCE_ASSETS "/spectacles/myopia.json"};
  live.record = file("a.csv");
  live.screenshot = file("live.png");
  const app::VrReport report =
      app::run_vr(live, keys({{2, {Control::next_pair}},
                              {3, {Control::map}},
                              {4, {Control::spectacles}},
                              {5, {Control::clear_view}},
                              {6, {Control::map, Control::next_pair}},
                              {7, {Control::clear_view}},
                              {8, {Control::recentre, Control::next_target}},
                              {9, {Control::compare}},
                              {10, {Control::map, Control::map, Control::map, Control::map}}}));
  EXPECT_EQ(report.kernels_late, 0U);
  EXPECT_EQ(report.shown, 14);
  const json record = json::parse(text_of(live.record + ".json"));
  const json expected = json::parse(R"([
      {"frame": 0, "pairs": [0], "picture": "adof"},
      {"frame": 2, "pairs": [1], "picture": "adof"},
      {"frame": 3, "pairs": [1], "picture": "power"},
      {"frame": 4, "pairs": [2], "picture": "power"},
      {"frame": 5, "pairs": [2], "picture": "pinhole"},
      {"frame": 7, "pairs": [2], "picture": "power"},
      {"frame": 9, "pairs": [1, 0], "picture": "power"},
      {"frame": 10, "pairs": [1, 0], "picture": "adof"}])");
  EXPECT_EQ(record["shown"], expected);
  std::vector<std::string> events;
  for (const json& event : record["events"]) {
    events.push_back(event["event"]);
  }
  EXPECT_EQ(events, (std::vector<std::string>{"next_pair", "map", "spectacles", "clear_view", "clear_view", "recentred",
                                              "next_target", "compare", "map", "map", "map", "map"}))
      << "while the view is clear, keys for other pictures are not heeded";

  // Recentred, the head is where the scene's camera stands, and faces where it does.
  const tracking::Pose start = *render::read_gltf(VERGENCE_BUILT_ASSETS "/reading_room.glb").start_pose();
  const std::vector<tracking::TraceRow> rows = tracking::read_gaze_trace(live.record).rows;
  const glm::dvec3 there = rows.at(8).head.position;
  EXPECT_NEAR(std::hypot(there.x - start.position.x, there.z - start.position.z), 0.0, 1e-9);
  const auto heading = [](const tracking::Pose& head) {
    const glm::dvec3 ahead = head.direction({0.0, 0.0, -1.0});
    return std::atan2(ahead.x, -ahead.z);
  };
  EXPECT_NEAR(heading(rows.at(8).head), heading(start), 1e-9);
  // The first target lies before that camera, so the eyes, which nothing tracks, go there.
  EXPECT_EQ(rows.at(7).source, tracking::GazeSource::head);
  EXPECT_EQ(rows.at(9).source, tracking::GazeSource::target);

  app::VrOptions again = live;
  again.record.clear();
  again.frames.reset();
  again.replay = live.record;
  again.screenshot = file("again.png");
  const app::VrReport replayed = app::run_vr(again);
  EXPECT_EQ(replayed.shown, 14);
  EXPECT_EQ(replayed.kernels_late, 0U);
  EXPECT_EQ(text_of(again.screenshot), text_of(live.screenshot));

  again.scene.further.clear();
  EXPECT_THROW((void)app::run_vr(again), tracking::InputError) << "a pair that the options do not name";
}

// A button of a controller clears the view: what is seen then is the scene of a wearer without spectacles or blur.
TEST_F(VrControls, AButtonClearsTheView) {
  const support::Monado monado({.remote = true});
  support::RemoteHub hub;
  app::VrOptions options = options_of(10);
  options.scene.spectacles = VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json";
  options.record = file("a.csv");
  options.screenshot = file("cleared.png");
  int frame = 0;
  const app::VrReport cleared = app::run_vr(options, [&] {
    if (++frame == 5) {
      support::RemoteHands hands;
      hands.left.trigger_click = true;
      hub.tell(hands);
    }
    return std::vector<Control>{};
  });
  EXPECT_EQ(cleared.kernels_late, 0U);
  const json record = json::parse(text_of(options.record + ".json"));
  ASSERT_FALSE(record["events"].empty());
  EXPECT_EQ(record["events"].back()["event"], "clear_view");
  EXPECT_EQ(record["shown"].back()["picture"], "pinhole");

  app::VrOptions bare = options_of(2);
  bare.scene.spectacles = "none";
  bare.mode = "pinhole";
  bare.picture.accuracy = "standard";  // as the clear view is drawn, whatever the rate
  bare.screenshot = file("bare.png");
  (void)app::run_vr(bare);
  // The eyes came from other distances of fixation, so pupils stand a hair elsewhere.
  EXPECT_GE(render::compare(render::read_png(file("cleared.png")), render::read_png(file("bare.png"))).psnr_db, 40.0);
}

}  // namespace
