// `vergence render --headset` tells the viewer what no picture can help.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/run_program.hpp"
#include "tests/support/tiny_scene.hpp"

namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

class ViewerWarning : public testing::Test {
 protected:
  ViewerWarning() {
    scene_ = folder_.write("scene.gltf", support::patch_gltf({support::wall(3.0F, 5.0F, 1.0F)}).text());
  }

  std::string run(Words words) {
    Words all{"render",  "--scene",  scene_,
              "--size",  "16x16",    "--mode",
              "pinhole", "--output", (folder_.path() / "out.png").string()};
    all.insert(all.end(), words.begin(), words.end());
    const auto result = support::run_program({.arguments = all});
    EXPECT_EQ(result.exit_status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result.out;
  }

  support::TemporaryFolder folder_;
  std::string scene_;
};

const std::string kPrism = VERGENCE_ASSETS "/spectacles/prism.json";  // 1 base up right, 1 base down left

TEST_F(ViewerWarning, IsInTableAndJson) {
  const std::string wearer =
      folder_.write("wearer.json", R"({"age": 60, "viewer": {"age": 30, "left": {"refraction": {"sphere": -3}}}})");
  const std::string headset = folder_.write("headset.json", R"({"focal_distance_m": 1.3})");
  const Words words{"--wearer", wearer, "--headset", headset, "--spectacles", kPrism};
  const json findings =
      json::parse(run({"--json", "--wearer", wearer, "--headset", headset, "--spectacles", kPrism})).at("findings");
  ASSERT_EQ(findings.size(), 3U);
  EXPECT_EQ(findings[0].at("code"), "own_blur");
  EXPECT_EQ(findings[0].at("eye"), "left");
  EXPECT_NEAR(findings[0].at("value").get<double>(), 2.09, 0.01);
  EXPECT_EQ(findings[1].at("code"), "convergence");
  EXPECT_EQ(findings[2].at("code"), "vertical_prism");
  // 1 base up less 1 base down; seen 16 mm from the lens it is what the lensmeter says, but for the eye's own turn.
  EXPECT_NEAR(findings[2].at("value").get<double>(), 2.0, 0.05);
  const std::string table = run(words);
  EXPECT_NE(table.find("warning: the viewer's own left eye is 2.09 D off"), std::string::npos) << table;
  EXPECT_NE(table.find("warning: at 30 years"), std::string::npos);
  EXPECT_NE(table.find("warning: the lenses' vertical prisms differ by"), std::string::npos);
}

TEST_F(ViewerWarning, OnADesktopNobodyWearsAHeadset) {
  EXPECT_FALSE(json::parse(run({"--json", "--spectacles", kPrism})).contains("findings"));
}

}  // namespace
