// What a session in the headset is made with: where the scene stands, and how exactly it is drawn.
#include "app/vr/setup.hpp"

#include <gtest/gtest.h>

#include <random>

#include "app/vr/prism_watch.hpp"
#include "render/ladder.hpp"
#include "tracking/input_error.hpp"

namespace {

using app::RungChoice;
using tracking::Pose;

// Wherever the head is and looks, after recentring it stands where the start says, turned as the start is; the vertical
// stays vertical, and on a floor the floor stays the floor.
TEST(Recentring, PutsTheStartWhereTheHeadIs) {
  std::mt19937_64 random(11);  // the seed
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  render::Scene scene;
  app::SceneOptions options;
  options.pose = "1.5,1.2,-2,40,-10";
  const glm::dvec3 place(1.5, 1.2, -2.0);
  const double yaw = 40.0 * 0.017453292519943295;
  for (const XrReferenceSpaceType type : {XR_REFERENCE_SPACE_TYPE_LOCAL, XR_REFERENCE_SPACE_TYPE_STAGE}) {
    for (int i = 0; i < 200; ++i) {
      const double turn = 3.0 * unit(random), pitch = 1.5 * unit(random);  // rad; up to 86 degrees up and down
      const Pose head{tracking::orientation_from_yaw_pitch(turn, pitch),
                      {unit(random), 1.0 + unit(random), unit(random)}};
      const Pose world_from_space = app::recentred(options, scene, type, head);
      const Pose there = world_from_space * head;
      const Pose expected{tracking::orientation_from_yaw_pitch(yaw, pitch), place};
      EXPECT_NEAR(there.position.x, place.x, 1e-9);
      EXPECT_NEAR(there.position.z, place.z, 1e-9);
      const bool on_floor = type == XR_REFERENCE_SPACE_TYPE_STAGE;
      EXPECT_NEAR(there.position.y, on_floor ? head.position.y : place.y, 1e-9);
      // Quaternions of the same turn, whichever sign.
      EXPECT_NEAR(std::abs(glm::dot(there.orientation, expected.orientation)), 1.0, 1e-9) << turn << ' ' << pitch;
      EXPECT_NEAR(world_from_space.direction({0.0, 1.0, 0.0}).y, 1.0, 1e-12);
    }
  }
}

TEST(Rungs, AreCoarserAndCheaperInTurn) {
  for (const bool tracks_gaze : {false, true}) {
    const std::vector<render::GovernorRung> rungs = app::governed_rungs(tracks_gaze);
    EXPECT_EQ(rungs.front().name, "standard");
    for (std::size_t i = 1; i < rungs.size(); ++i) {
      EXPECT_LT(rungs[i].cost, rungs[i - 1].cost) << rungs[i].name;
    }
    const bool foveated = std::ranges::any_of(
        rungs, [](const render::GovernorRung& rung) { return rung.accuracy.foveation.fovea_deg > 0.0; });
    EXPECT_EQ(foveated, tracks_gaze) << "what nobody tracks may be looked at anywhere";
    for (const render::GovernorRung& rung : rungs) {
      EXPECT_EQ(app::find_live_rung(rung.name)->accuracy.resolution, rung.accuracy.resolution)
          << "read from a recording";
    }
  }
  EXPECT_FALSE(app::find_live_rung("fine"));
}

// A display of 90 Hz whose runtime, waiting for late frames, says that it has 45: the pictures still go for 90.
TEST(Rungs, AimAtTheDisplaysOwnPeriod) {
  RungChoice rungs(app::governed_rungs(false), render::GovernorConfig{});
  for (int i = 0; i < 20; ++i) {
    rungs.see_period(i == 0 ? 1.0 / 90.0 : 1.0 / 45.0);
    rungs.see(i / 45.0, rungs.rung(), rungs.rungs()[rungs.rung()].cost / 60.0);
  }
  EXPECT_GT(rungs.rung(), 0U);
  EXPECT_EQ(rungs.switches(), 1);
}

TEST(Rungs, OfAReplayAreThoseThatWereRecorded) {
  app::VrOptions options;
  app::SessionRecord record;
  record.rungs = {{0, "standard"}, {1, "standard at 50 %"}};
  tracking::GazeTrace trace;
  trace.rows.resize(2);
  trace.rows[1].time = 1.0;
  const app::SessionReplay replay(trace, record, "a.csv.json");
  RungChoice recorded = app::rung_choice(options, replay, false);
  ASSERT_EQ(recorded.rungs().size(), 2U);
  recorded.use_named("standard at 50 %");
  EXPECT_EQ(recorded.rungs()[recorded.rung()].accuracy.resolution, 0.5);
  options.picture.accuracy = "blur-16-taps";
  EXPECT_EQ(app::rung_choice(options, replay, false).rungs().front().name, "blur-16-taps");
  options.picture.accuracy = "auto";
  record.rungs[1].name = "fine";
  try {
    (void)app::rung_choice(options, app::SessionReplay(trace, record, "a.csv.json"), false);
    ADD_FAILURE() << "was taken";
  } catch (const tracking::InputError& error) {
    EXPECT_EQ(error.file(), "a.csv.json");
    EXPECT_EQ(error.field(), "rungs[1].name");
  }
}

TEST(PrismWatch, WarnsOnceAndDoesNotFlicker) {
  const auto prism = [](const char* words) {
    return app::ViewerFinding{"A", {.code = "vertical_prism", .side = {}, .value = 1.2, .unit = "", .message = words}};
  };
  app::PrismWatch watch;
  EXPECT_TRUE(watch.see(0.0, {}).empty());
  ASSERT_EQ(watch.see(0.1, {prism("1.2")}).size(), 1U);
  for (int i = 0; i < 20; ++i) {  // about the limit
    EXPECT_TRUE(
        watch.see(0.2 + 0.1 * i, i % 2 == 0 ? std::vector{prism("1.1")} : std::vector<app::ViewerFinding>{}).empty());
    ASSERT_EQ(watch.current().size(), 1U);
    EXPECT_EQ(watch.current()[0].finding.message, "1.2") << "words that change could not be read";
  }
  (void)watch.see(10.0, {});
  EXPECT_TRUE(watch.current().empty());
  EXPECT_EQ(watch.see(11.0, {prism("1.3")}).size(), 1U);
}

}  // namespace
