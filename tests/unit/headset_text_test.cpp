// What a session tells the person inside: from its files, its wearer and its gaze, without a headset.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/vr/headset_text.hpp"
#include "lenses/pupil.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/tiny_scene.hpp"

namespace {

using app::NoticeContent;
using app::VrOptions;
using app::VrWorld;

constexpr const char* kShortSighted = R"({
  "age": 60,
  "viewer": {"right": {"refraction": {"sphere": -3}, "worn_in_headset": "nothing"},
             "left": {"refraction": {"sphere": -0.5}, "worn_in_headset": "nothing"}}
})";

class HeadsetTextTest : public testing::Test {
 protected:
  HeadsetTextTest() {
    options_.scene.scene = folder_.write("scene.gltf", support::patch_gltf({support::wall(2.0F, 3.0F, 0.5F)}).text());
    const double t = std::tan(45.0 * std::numbers::pi / 180.0);
    for (const double side : {1.0, -1.0}) {
      tracking::EyeView& view = where_.eyes[side > 0.0 ? 0 : 1];
      view.head_from_view.position.x = side * 0.0315;
      view.fov = {t, t, t, t};
    }
  }

  static tracking::GazeSample ahead(double time) {
    const glm::dvec3 forward(0.0, 0.0, -1.0);
    return {.time = time, .eye = {forward, forward}, .combined = {}, .valid = true};
  }

  support::TemporaryFolder folder_;
  VrOptions options_;
  app::HeadAndViews where_;
};

TEST_F(HeadsetTextTest, NamesPairsRungAndMap) {
  options_.scene.spectacles = VERGENCE_ASSETS "/spectacles/presbyopia_bifocal.json";
  options_.scene.compare = VERGENCE_ASSETS "/spectacles/emmetropia.json";
  options_.mode = "astigmatism";
  options_.picture.accuracy = "lens-2-iterations";
  VrWorld world(options_);
  world.choose_rungs(false);
  world.place(0.0, where_, std::nullopt);
  const NoticeContent content = app::notice_content(world, {{"Letters", "none"}});
  ASSERT_EQ(content.pairs.size(), 2U);
  EXPECT_EQ(content.pairs[0], world.wearer().setup().pairs[0].name);
  EXPECT_EQ(content.pairs[1], world.wearer().setup().pairs[1].name);
  EXPECT_NE(content.pairs[0], content.pairs[1]);
  EXPECT_EQ(content.rung, "lens-2-iterations");
  EXPECT_EQ(content.map, "astigmatism");
  EXPECT_EQ(content.limits.size(), 1U);
}

TEST_F(HeadsetTextTest, NamesTheGazeSourceOfEveryMoment) {
  VrWorld world(options_);
  world.choose_rungs(false);
  const auto source_at = [&](double time, const std::optional<tracking::GazeSample>& sample) {
    world.place(time, where_, sample);
    return app::notice_content(world, {}).gaze_source;
  };
  EXPECT_EQ(source_at(0.0, std::nullopt), "head");
  EXPECT_EQ(source_at(0.1, ahead(0.1)), "tracker");
  tracking::GazeSample blink = ahead(0.2);
  blink.valid = false;
  EXPECT_EQ(source_at(0.2, blink), "held");
  const NoticeContent content = app::notice_content(world, {});
  EXPECT_EQ(content.pairs, std::vector<std::string>{"no spectacles"});
  EXPECT_EQ(content.map, "");
}

TEST_F(HeadsetTextTest, WarnsOfTheViewersOwnEyesFromTheFirstPicture) {
  options_.scene.wearer = folder_.write("wearer.json", kShortSighted);
  VrWorld world(options_);
  world.choose_rungs(false);
  world.place(0.0, where_, std::nullopt);
  world.warn(0.063);
  const NoticeContent content = app::notice_content(world, {});
  ASSERT_EQ(content.warnings.size(), 1U);
  EXPECT_NE(content.warnings[0].find("right eye is 2."), std::string::npos) << content.warnings[0];  // -3 + 1/1.5
}

TEST_F(HeadsetTextTest, WarnsOfAnotherPairOnceItIsPutOn) {
  options_.scene.spectacles = VERGENCE_ASSETS "/spectacles/myopia.json";
  options_.scene.further = {folder_.write("prism.json", R"({
    "name": "prism", "left": {"prescription": {"sphere": -1}},
    "right": {"prescription": {"sphere": -1, "prism": [{"magnitude": 2, "base": 90}]}}})")};
  VrWorld world(options_);
  world.choose_rungs(false);
  const auto codes_at = [&](double time) {
    world.place(time, where_, std::nullopt);
    std::vector<std::string> codes;
    for (const app::ViewerFinding& warning : world.warnings()) {
      codes.push_back(warning.finding.code + " " + warning.pair);
    }
    return codes;
  };
  world.place(0.0, where_, std::nullopt);
  world.warn(0.063);
  EXPECT_EQ(codes_at(0.1), std::vector<std::string>{});
  world.apply(xr::Control::next_pair);
  EXPECT_EQ(codes_at(0.2), std::vector<std::string>{"vertical_prism prism"});
  EXPECT_EQ(app::notice_content(world, {}).pairs, std::vector<std::string>{"prism"});
  world.apply(xr::Control::clear_view);
  EXPECT_EQ(codes_at(0.3), std::vector<std::string>{});
  EXPECT_EQ(app::notice_content(world, {}).pairs, std::vector<std::string>{"clear view"});
  world.apply(xr::Control::clear_view);
  EXPECT_EQ(codes_at(0.4).size(), 1U);
  EXPECT_EQ(world.report().findings.size(), 1U) << "the report names what was warned of, once";
}

TEST_F(HeadsetTextTest, LimitsAreTheDisplaysOrThePicturesWhicheverIsCoarser) {
  VrWorld world(options_);
  world.choose_rungs(false);
  world.place(0.0, where_, std::nullopt);
  const tracking::FieldOfView& fov = where_.eyes[0].fov;
  const double of_1000 = 1000 / 2.0 * std::numbers::pi / 180.0;  // a 90 degree field, at its axis
  const auto seen = [&](bool file, int image, int display) {
    return app::display_limits(world.wearer().setup(), file, fov, image, display).pixels_per_degree;
  };
  EXPECT_NEAR(seen(false, 3000, 1000), of_1000, 1e-9);
  EXPECT_NEAR(seen(false, 1000, 3000), of_1000, 1e-9);
  EXPECT_EQ(seen(true, 9000, 1000), world.wearer().setup().headset->pixels_per_degree);
  EXPECT_NEAR(seen(true, 1000, 9000), of_1000, 1e-9);
  const app::DisplayLimits limits = app::display_limits(world.wearer().setup(), false, fov, 1000, 1000);
  EXPECT_FALSE(limits.viewer_known);
  // The default wearer, 35 years: the pupil that the display's 100 cd/m2 leaves, and a smaller one in sunlight.
  EXPECT_NEAR(limits.pupil_diameter, lenses::pupil_diameter_in_light(100.0, app::kHeadsetField_deg2, true, 35.0), 1e-4);
  EXPECT_LT(limits.sunlit_pupil, limits.pupil_diameter - 0.0005);
}

}  // namespace
