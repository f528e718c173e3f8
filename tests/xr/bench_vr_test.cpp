// `vergence bench --vr` on a real runtime.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/monado.hpp"
#include "tests/support/run_program.hpp"

namespace {

using nlohmann::json;
using support::ProgramResult;

ProgramResult bench(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"bench", "--vr"});
  // A loaded machine draws a frame of lavapipe's in seconds.
  return support::run_program({.arguments = std::move(arguments), .time_limit = std::chrono::seconds(300)});
}

TEST(BenchVr, TimesEachPartOfAFrameForEachLens) {
  const support::Monado monado;
  const ProgramResult result = bench({"--lens", "none,sphere/sphere", "--mode", "pin", "--frames", "3", "--size", "32",
                                      "--json", "--scene", VERGENCE_BUILT_ASSETS "/reading_room.glb"});
  ASSERT_EQ(result.exit_status, 0) << result.err << monado.said();
  const json rows = json::parse(result.out);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["lens"], "none");
  EXPECT_EQ(rows[1]["lens"], "sphere/sphere");
  for (const json& row : rows) {
    EXPECT_EQ(row["mode"], "pin");
    EXPECT_EQ(row["size"], "32x32");
    EXPECT_EQ(row["frames_shown"], 3);
    EXPECT_GT(row["period_ms"], 0.0);
    double parts = 0.0;
    for (const char* part : {"locate", "place", "device wait", "image wait", "text", "submit"}) {
      ASSERT_TRUE(row["host_ms"].contains(part)) << part;
      parts += row["host_ms"][part]["max"].get<double>();
    }
    // The way to the submission is made of these parts.
    EXPECT_GT(row["wait_to_submit_ms"]["median"], 0.0);
    EXPECT_LE(row["wait_to_submit_ms"]["median"], parts);
    EXPECT_GT(row["frame_code_cpu_ms"]["median"], 0.0);
    EXPECT_GT(row["stages_ms"]["trace"]["median"], 0.0);
  }
}

TEST(BenchVr, SaysWhatDoesNotGoWithIt) {
  ::setenv("XR_RUNTIME_JSON", "/nonexistent/runtime.json", 1);
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"--rounds", "2"},
                                              {"--shading", "bare"},
                                              {"--traversal", "tile"},
                                              {"--frames", "1"},
                                              {"--size", "32,64"},
                                              {"--seed", "1"},
                                              {"--lens", "glass"}}) {
    const ProgramResult result = bench(bad);
    EXPECT_EQ(result.exit_status, 2) << bad[0] << ": " << result.err;
    EXPECT_NE(result.err.find(bad[0] + ": "), std::string::npos) << result.err;
  }
  const ProgramResult none = bench({"--frames", "2"});
  EXPECT_EQ(none.exit_status, 1);
  EXPECT_NE(none.err.find("start one"), std::string::npos) << none.err;
}

}  // namespace
