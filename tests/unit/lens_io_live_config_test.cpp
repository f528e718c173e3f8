// The wearer file's parameters of eyes and tracker in time.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "lens_io_fixtures.hpp"

namespace {

using namespace lens_io_fixtures;

json good_live() {
  json wearer = good_wearer();
  wearer["viewer"]["age"] = 61;
  wearer["accommodation"] = {
      {"latency_s", 0.3}, {"time_constant_s", 0.2}, {"slope", 0.85}, {"tonic_D", 0.5}, {"depth_of_focus_D", 0.25}};
  wearer["pupil"] = {{"latency_s", 0.2}, {"constriction_time_constant_s", 0.3}, {"dilation_time_constant_s", 0.9}};
  wearer["tracking"] =
      json::parse(R"({"target": {"rest_cutoff_Hz": 2, "speed_slope_per_deg": 0.3, "speed_cutoff_Hz": 3},
    "pupil_position": {"rest_cutoff_Hz": 0.1}, "saccade": {"least_speed_deg_per_s": 40, "noise_multiple": 5,
    "start_noise_deg_per_s": 15, "window_s": 0.03, "longest_s": 0.2}, "noise_deg": 0.5, "hold_s": 0.4,
    "return_time_constant_s": 0.1, "depth_dwell_s": 0.2})");
  return wearer;
}

TEST(LiveConfig, IsReadInSiUnits) {
  const lenses::Wearer wearer = lenses::parse_wearer(good_live().dump(), "f.json");
  EXPECT_EQ(wearer.viewer_age, 61.0);
  const auto& a = wearer.live.accommodation;
  EXPECT_EQ(a.latency, 0.3);
  EXPECT_EQ(a.time_constant, 0.2);
  EXPECT_EQ(a.slope, 0.85);
  EXPECT_EQ(a.tonic, 0.5);
  EXPECT_EQ(a.depth_of_focus, 0.25);
  EXPECT_EQ(wearer.live.pupil.latency, 0.2);
  EXPECT_EQ(wearer.live.pupil.constriction_time_constant, 0.3);
  EXPECT_EQ(wearer.live.pupil.dilation_time_constant, 0.9);
  const auto& g = wearer.live.gaze;
  EXPECT_EQ(g.target.rest_cutoff, 2.0);
  EXPECT_DOUBLE_EQ(g.target.speed_slope, 0.3 / kDegree);
  EXPECT_EQ(g.target.speed_cutoff, 3.0);
  EXPECT_EQ(g.pupil.rest_cutoff, 0.1);
  EXPECT_EQ(g.pupil.speed_slope, tracking::GazeConfig{}.pupil.speed_slope) << "what is absent keeps its default";
  EXPECT_DOUBLE_EQ(g.saccade.least_speed, 40.0 * kDegree);
  EXPECT_EQ(g.saccade.noise_multiple, 5.0);
  EXPECT_DOUBLE_EQ(g.saccade.start_noise, 15.0 * kDegree);
  EXPECT_EQ(g.saccade.window, 0.03);
  EXPECT_EQ(g.saccade.longest, 0.2);
  EXPECT_DOUBLE_EQ(g.noise, 0.5 * kDegree);
  EXPECT_EQ(g.hold, 0.4);
  EXPECT_EQ(g.return_time_constant, 0.1);
  EXPECT_EQ(g.depth_dwell, 0.2);
}

TEST(LiveConfig, ReadsBackAsItWasWritten) {
  const lenses::Wearer wearer = lenses::parse_wearer(good_live().dump(), "f.json");
  const std::string text = lenses::to_json(wearer);
  const lenses::Wearer again = lenses::parse_wearer(text, "f.json");
  EXPECT_EQ(again.live, wearer.live);
  EXPECT_EQ(again.viewer_age, wearer.viewer_age);
  EXPECT_NE(text.find("\"speed_slope_per_deg\": 0.3,"), std::string::npos) << text;
  EXPECT_EQ(lenses::to_json(lenses::Wearer{}).find("tracking"), std::string::npos) << "defaults stay unsaid";
}

// The example says every parameter, and says the defaults.
TEST(LiveConfig, TheExampleHoldsTheDefaults) {
  const std::string path = std::string(VERGENCE_ASSETS) + "/wearers/young_tracked.json";
  const lenses::Wearer wearer = lenses::read_wearer(path);
  EXPECT_EQ(wearer.live, tracking::LiveConfig{});
  std::ifstream file(path);
  const json document = json::parse(file);
  EXPECT_EQ(document["tracking"].size(), 7U);
  EXPECT_EQ(document["tracking"]["saccade"].size(), 5U);
  EXPECT_EQ(document["accommodation"].size(), 5U);
  EXPECT_EQ(document["pupil"].size(), 3U);
}

TEST(LiveConfig, NamesTheFieldOfEveryError) {
  expect_all_refused(
      kWearer, good_live(),
      {
          {"/viewer/age", "0", "viewer.age", "from 1 to 120"},
          {"/accommodation/latency_s", "-0.1", "accommodation.latency_s", "from 0 to 2"},
          {"/accommodation/time_constant_s", "0", "accommodation.time_constant_s", "from 0.01 to 5"},
          {"/accommodation/slope", "0", "accommodation.slope", "from 0.1 to 1.5"},
          {"/accommodation/tonic_D", "6", "accommodation.tonic_D", "from 0 to 5"},
          {"/accommodation/depth_of_focus_D", "null", "accommodation.depth_of_focus_D", "is null"},
          {"/accommodation/lag", "1", "accommodation.lag", "allowed: latency_s, time_constant_s"},
          {"/accommodation", "3", "accommodation", "object"},
          {"/pupil/latency_s", "3", "pupil.latency_s", "from 0 to 2"},
          {"/pupil/constriction_time_constant_s", "0", "pupil.constriction_time_constant_s", "from 0.01 to 10"},
          {"/pupil/dilation_time_constant_s", "\"slow\"", "pupil.dilation_time_constant_s", "must be a number"},
          {"/pupil/diameter_mm", "3", "pupil.diameter_mm", "is an unknown key"},
          {"/tracking/target/rest_cutoff_Hz", "0", "tracking.target.rest_cutoff_Hz", "from 0.01 to 100"},
          {"/tracking/target/speed_slope_per_deg", "-1", "tracking.target.speed_slope_per_deg", "from 0 to 10"},
          {"/tracking/pupil_position/beta", "1", "tracking.pupil_position.beta", "allowed: rest_cutoff_Hz"},
          {"/tracking/saccade/least_speed_deg_per_s", "0", "tracking.saccade.least_speed_deg_per_s", "from 1 to 1000"},
          {"/tracking/saccade/window_s", "1", "tracking.saccade.window_s", "from 0.001 to 0.1"},
          {"/tracking/noise_deg", "11", "tracking.noise_deg", "from 0 to 10"},
          {"/tracking/hold_s", "0", "tracking.hold_s", "from 0.1 to 10"},
          {"/tracking/smoothing", "1", "tracking.smoothing", "allowed: target, pupil_position"},
      });
}

}  // namespace
