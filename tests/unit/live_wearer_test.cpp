// The wearer in the headset: pairs put on and taken off, and eyes on a thing of the scene.
#include "app/vr/live_wearer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tracking/direction.hpp"

namespace {

using app::HeadAndViews;
using app::LiveWearer;
using tracking::GazeSource;

constexpr double kFrame = 1.0 / 90.0;
constexpr double kDegree = std::numbers::pi / 180.0;

class LiveWearerTest : public testing::Test {
 protected:
  LiveWearerTest() : scene_(render::read_gltf(VERGENCE_BUILT_ASSETS "/reading_room.glb")) {
    app::SceneOptions options;
    options.wearer = VERGENCE_ASSETS "/wearers/presbyopia.json";
    options.spectacles = VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json";
    options.further = {VERGENCE_ASSETS "/spectacles/myopia.json"};
    options.in_headset = options.bare_too = true;
    setup_ = app::make_render_setup(options, scene_);
    where_.world_from_head = app::start_pose(options, scene_);
    for (const std::size_t i : {0U, 1U}) {
      where_.eyes[i].head_from_view.position = {i == 0 ? 0.0315 : -0.0315, 0.0, 0.0};
      where_.eyes[i].fov = {1.0, 1.0, 1.0, 1.0};
    }
  }

  [[nodiscard]] glm::dvec3 target(const std::string& name) const {
    return std::ranges::find(scene_.targets, name, &render::Target::name)->position;
  }
  // For a time; returns when it ended.
  double look(LiveWearer& wearer, double from, double seconds, const std::optional<glm::dvec3>& at,
              const std::optional<tracking::GazeSample>& sample = std::nullopt) const {
    double time = from;
    for (; time < from + seconds; time += kFrame) {
      wearer.step(time, where_, sample, at);
    }
    return time;
  }

  render::Scene scene_;
  app::RenderSetup setup_;
  HeadAndViews where_;
};

TEST_F(LiveWearerTest, EyesTurnToATargetThroughTheirLensesAndBack) {
  LiveWearer wearer(setup_, scene_);
  const glm::dvec3 card = target("near_card");
  // Head first, so that the card is within reach.
  const glm::dvec3 way = card - where_.world_from_head.position;
  where_.world_from_head.orientation = tracking::orientation_from_yaw_pitch(std::atan2(way.x, -way.z), 0.0);
  double time = look(wearer, 0.0, 1.0, std::nullopt);
  EXPECT_EQ(wearer.source(), GazeSource::head);
  const glm::dvec3 ahead = wearer.state().gaze[0];
  time = look(wearer, time, 1.5, card);
  EXPECT_EQ(wearer.source(), GazeSource::target);
  for (const render::LineOfSight& line : wearer.setup().pairs[0].fixation.line) {
    // The eye's line beyond its lens; the card is a hand's breadth wide at 0.4 m.
    EXPECT_LE(tracking::angle_between(line.direction, glm::normalize(card - line.start)), 0.3 * kDegree);
    EXPECT_TRUE(line.through_lens);
  }
  EXPECT_NEAR(wearer.state().distance, glm::length(way), 0.05 * glm::length(way)) << "and it is the card's distance";
  // A tracker knows better than a wish.
  tracking::GazeSample sample;
  sample.combined = tracking::Line{{}, glm::dvec3(0.0, 0.0, -1.0)};
  time = look(wearer, time, 0.5, card, sample);
  EXPECT_EQ(wearer.source(), GazeSource::tracker);
  // Back to where the head points, by itself.
  time = look(wearer, time, 3.0, std::nullopt);
  EXPECT_EQ(wearer.source(), GazeSource::head);
  EXPECT_LE(tracking::angle_between(wearer.state().gaze[0], ahead), 0.1 * kDegree);
}

TEST_F(LiveWearerTest, ATargetBehindTheHeadIsOutOfReach) {
  LiveWearer wearer(setup_, scene_);
  const glm::dvec3 behind = where_.world_from_head.point({0.0, 0.0, 2.0});
  look(wearer, 0.0, 2.0, behind);
  EXPECT_EQ(wearer.source(), GazeSource::head);
  EXPECT_LE(tracking::angle_between(wearer.state().gaze[0], {0.0, 0.0, -1.0}), 5.0 * kDegree);
}

// Spectacles do not jolt the eyes behind them: what is put on finds them as they were.
TEST_F(LiveWearerTest, APairFindsTheEyesAsTheyWere) {
  LiveWearer wearer(setup_, scene_);
  look(wearer, 0.0, 2.0, std::nullopt);
  const tracking::EyeState before = wearer.state();
  EXPECT_GT(before.accommodation[0], 0.01) << "or there is nothing to keep";
  const std::array<std::size_t, 2> both{2, 1};
  wearer.wear(both);
  ASSERT_EQ(wearer.setup().pairs.size(), 2U);
  ASSERT_EQ(wearer.setup().views.size(), 4U);
  EXPECT_EQ(wearer.setup().pairs[0].name, "no spectacles");
  for (const std::size_t worn : {0U, 1U}) {
    EXPECT_EQ(wearer.state(worn).accommodation, before.accommodation);
    EXPECT_EQ(wearer.state(worn).pupil_diameter, before.pupil_diameter);
  }
  look(wearer, 2.0, 2.0, std::nullopt);
  EXPECT_NE(wearer.state(0).demand[0], wearer.state(1).demand[0]) << "then each lens has its way";
}

TEST_F(LiveWearerTest, RoundingOfARuntimesPosesIsNoMove) {
  HeadAndViews now = where_;
  now.eyes[0].head_from_view.position.x += 1e-6;
  now.eyes[1].head_from_view.orientation = glm::angleAxis(1e-6, glm::dvec3(0.0, 1.0, 0.0));
  const HeadAndViews same = app::steadied(now, where_.eyes);
  EXPECT_EQ(same.eyes[0].head_from_view.position, where_.eyes[0].head_from_view.position);
  EXPECT_EQ(same.eyes[1].head_from_view.orientation, where_.eyes[1].head_from_view.orientation);
  now.eyes[0].head_from_view.position.x += 1e-4;  // somebody sets the distance of the lenses
  now.eyes[1].fov.tan_up += 1e-4;
  const HeadAndViews moved = app::steadied(now, where_.eyes);
  EXPECT_EQ(moved.eyes[0].head_from_view.position, now.eyes[0].head_from_view.position);
  EXPECT_EQ(moved.eyes[1].fov.tan_up, now.eyes[1].fov.tan_up);
}

}  // namespace
