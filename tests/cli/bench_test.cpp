// vergence bench as a user starts it: one tiny round, and the options it refuses.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/run_program.hpp"

namespace {

using nlohmann::json;

const std::string kRoom = std::string(VERGENCE_BUILT_ASSETS) + "/reading_room.glb";

TEST(Bench, TinyRoundGivesTheContractsRows) {
  const support::TemporaryFolder folder;
  const std::string report = (folder.path() / "report").string();
  const auto result = support::run_program({.arguments = {"bench", "--scene", kRoom, "--size", "16,32", "--rounds", "1",
                                                          "--lens", "none,bspline/torus", "--output", report, "--json"},
                                            .time_limit = std::chrono::seconds(300)});
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const json rows = json::parse(result.out);
  ASSERT_EQ(rows.size(), 2U * 2U * 5U) << "sizes, lenses; four modes bare and adof in full";
  for (const json& row : rows) {
    EXPECT_GT(row["ms_median"].get<double>(), 0.0);
    EXPECT_GE(row["ms_max"].get<double>(), row["ms_min"].get<double>());
    EXPECT_TRUE(row["stages_ms"].contains(row["mode"] == "dof" ? "samples" : "trace"));
    EXPECT_EQ(row["stages_ms"].contains("edges"), row["shading"] == "full");
    EXPECT_FALSE(row["device"].get<std::string>().empty());
    EXPECT_GT(row["embree16_ms"].get<double>(), 0.0);
  }
  for (const char* file : {"bench.csv", "bench.svg", "bench.png", "report.html"}) {
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(report) / file)) << file;
  }
}

TEST(Bench, TimesPairsOfTheUsersUnderSharedOptions) {
  const std::string assets = VERGENCE_ASSETS;
  const std::string mine = assets + "/spectacles/myopia.json", other = assets + "/spectacles/hyperopia.json";
  const auto result = support::run_program({.arguments = {"bench",
                                                          "--scene",
                                                          kRoom,
                                                          "--size",
                                                          "16",
                                                          "--rounds",
                                                          "1",
                                                          "--lens",
                                                          "none,bspline100/sphere",
                                                          "--mode",
                                                          "power,pinhole",
                                                          "--shading",
                                                          "bare",
                                                          "--json",
                                                          "--wearer",
                                                          assets + "/wearers/myopia.json",
                                                          "--spectacles",
                                                          mine,
                                                          "--compare",
                                                          other,
                                                          "--viewing",
                                                          "fixed",
                                                          "--headset",
                                                          assets + "/headsets/example.json",
                                                          "--look-at",
                                                          "near_card",
                                                          "--fov",
                                                          "40",
                                                          "--output-space",
                                                          "retina",
                                                          "--exposure",
                                                          "1",
                                                          "--accuracy",
                                                          "standard",
                                                          "--seed",
                                                          "3",
                                                          "--all-effects"},
                                            .time_limit = std::chrono::seconds(300)});
  ASSERT_EQ(result.exit_status, 0) << result.err;
  std::vector<std::string> seen;
  for (const json& row : json::parse(result.out)) {
    seen.push_back(row["lens"].get<std::string>() + " " + row["mode"].get<std::string>());
    EXPECT_FALSE(row.contains("paper_fps_at_1024") && row["lens"] != "none") << row;
  }
  const std::vector<std::string> expected{
      "none vis",    "none pin",    "bspline100/sphere vis", "bspline100/sphere pin",
      mine + " vis", mine + " pin", other + " vis",          other + " pin"};
  EXPECT_EQ(seen, expected);
}

// A device without ray queries says so; one with them traces by them.
TEST(Bench, RayQueriesRunOrAreRefused) {
  const auto result =
      support::run_program({.arguments = {"bench", "--scene", kRoom, "--size", "16", "--rounds", "1", "--lens", "none",
                                          "--mode", "pin", "--shading", "bare", "--traversal", "ray_query", "--json"},
                            .time_limit = std::chrono::seconds(300)});
  if (result.exit_status == 0) {
    EXPECT_TRUE(json::parse(result.out).at(0)["stages_ms"].contains("ray_query"));
  } else {
    EXPECT_EQ(result.exit_status, 1);
    EXPECT_TRUE(result.err.starts_with("vergence: --device: ")) << result.err;
    EXPECT_NE(result.err.find("VK_KHR_ray_query"), std::string::npos) << result.err;
    EXPECT_TRUE(result.out.empty());
  }
}

TEST(Bench, RefusesWhatItDoesNotKnow) {
  const std::vector<std::vector<std::string>> bad{{"--lens", "sphere/cube"}, {"--mode", "adof,,pin"},
                                                  {"--size", "0"},           {"--size", "512x512"},
                                                  {"--size", "1.5"},         {"--rounds", "0"},
                                                  {"--shading", "nice"},     {"--output", "/proc/none/x"},
                                                  {"--mode", "blur"},        {"--spectacles", "/none.json"},
                                                  {"--look-at", "nobody"},   {"--accuracy", "most"},
                                                  {"--exposure", "99"},      {"--lens", "none", "--figures", "x"},
                                                  {"--eye", "left"},         {"--traversal", "best"}};
  for (const auto& options : bad) {
    std::vector<std::string> arguments{"bench", "--scene", kRoom};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto result = support::run_program({.arguments = arguments});
    EXPECT_EQ(result.exit_status, 2) << options[0] << " " << options[1] << ": " << result.err;
    const std::string at_fault = options[0] == "--spectacles" ? options[1] : options[0];
    EXPECT_TRUE(result.err.starts_with("vergence: " + at_fault)) << result.err;
    EXPECT_TRUE(result.out.empty());
  }
}

}  // namespace
