// `vergence trace` with bad lines among good ones: each gets an error in its own place and the rest goes on.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/run_program.hpp"

namespace {

using nlohmann::json;
using support::ProgramResult;
using support::run_program;

struct BadLine {
  std::string text;
  std::string names;  // in its error
  json id = nullptr;
};

const std::string kGood = R"({"id": "good", "lens": null, "direction": [0, 0, -1], "object_distance_m": 0.5})";

std::vector<BadLine> bad_lines() {
  return {
      {"{\"id\": 1, \"direction\": [0, 0, -1", "line"},
      {"not json", "line"},
      {"", "line"},
      {"[]", "object"},
      {"7", "object"},
      {R"({"id": 2, "direction": [NaN, 0, -1]})", "line"},
      {R"({"id": 3, "direction": [0, 0, 0]})", "direction", 3},
      {R"({"id": 4})", "direction", 4},
      {R"({"id": 5, "direction": "ahead"})", "direction", 5},
      {R"({"id": 6, "direction": [0, -1]})", "direction", 6},
      {R"({"id": 7, "direction": [0, 0, null]})", "direction", 7},
      {R"({"id": 8, "direction": [0, 0, 1e999]})", "line"},
      {R"({"id": 9, "direction": [0, 0, -1], "object_distance_m": 0})", "object_distance_m", 9},
      {R"({"id": 10, "direction": [0, 0, -1], "object_distance_m": -2})", "object_distance_m", 10},
      {R"({"id": 11, "direction": [0, 0, -1], "side": "middle"})", "side", 11},
      {R"({"id": 12, "direction": [0, 0, -1], "viewing": "fast"})", "viewing", 12},
      {R"({"id": 13, "direction": [0, 0, -1], "viewing": "gaze", "gaze": [0, 0, 0]})", "gaze", 13},
      {R"({"id": 14, "direction": [0, 0, -1], "lens": 3})", "lens", 14},
      {R"({"id": 15, "direction": [0, 0, -1], "lens": {"index": 1.5}})", "lens.", 15},
      {R"({"id": 16, "direction": [0, 0, -1], "lens_file": "missing.json"})", "missing.json", 16},
      {R"({"id": 17, "direction": [0, 0, -1], "lens_file": 17})", "lens_file", 17},
      {R"({"id": 18, "direction": [0, 0, -1], "eye": {"axial_length_mm": "long"}})", "eye.axial_length_mm", 18},
      {R"({"id": 19, "direction": [0, 0, -1], "colour": "red"})", "colour", 19},
      {std::string(200000, '['), "64"},
      {"{\"id\": 21, \"direction\": [0, 0, -1], \"\xff\": 1}", "line"},
  };
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

void expect_answers(const std::string& engine) {
  std::string input = kGood + "\n";
  const auto bad = bad_lines();
  for (const BadLine& line : bad) {
    input += line.text + "\n" + kGood + "\n";
  }
  const ProgramResult result = run_program({.arguments = {"trace", "--engine", engine}, .input = input});
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  EXPECT_TRUE(result.err.starts_with("vergence: --input: " + std::to_string(bad.size()) + " of ")) << result.err;
  const auto answers = lines_of(result.out);
  ASSERT_EQ(answers.size(), 2 * bad.size() + 1);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    SCOPED_TRACE(answers[i]);
    ASSERT_TRUE(json::accept(answers[i]));
    const json answer = json::parse(answers[i]);
    if (i % 2 == 0) {
      EXPECT_EQ(answer["id"], "good");
      EXPECT_EQ(answer["status"], "ok");
      // -1/0.5 m, whichever engine; the GPU's floats are good to 1e-6 here.
      EXPECT_NEAR(answer["power_D"].get<double>(), -2.0, 1e-6);
      EXPECT_FALSE(answer.contains("error"));
      continue;
    }
    const BadLine& line = bad[i / 2];
    ASSERT_TRUE(answer.contains("error")) << line.text.substr(0, 100);
    const std::string error = answer["error"];
    EXPECT_NE(error.find(line.names), std::string::npos);
    EXPECT_NE(error.find("line " + std::to_string(i + 1)), std::string::npos) << "no line number";
    EXPECT_EQ(answer["id"], line.id);
  }
}

TEST(BadRays, GetAnErrorInTheirPlace) {
  expect_answers("reference");
}

TEST(BadRays, GetAnErrorInTheirPlaceOnTheGpu) {
  expect_answers("gpu");
}

void expect_refused(const std::vector<std::string>& words, int status, const std::string& start) {
  const ProgramResult result = run_program({.arguments = words, .input = kGood + "\n"});
  EXPECT_EQ(result.exit_status, status);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(result.err.starts_with("vergence: " + start + ": ")) << result.err;
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
}

TEST(BadRays, InputsThatCannotBeRead) {
  const support::TemporaryFolder folder;
  const std::string missing = (folder.path() / "missing.jsonl").string();
  expect_refused({"trace", "--input", missing}, 2, missing);
  expect_refused({"trace", "--input", folder.path().string()}, 2, folder.path().string());
  expect_refused({"trace", "--input", ""}, 2, "--input");
  expect_refused({"trace", "--engine", "fast"}, 2, "--engine");
  expect_refused({"trace", "--engine", "gpu", "--device", "nonsense"}, 1, "--device");
  expect_refused({"trace", "--nonsense"}, 2, "--nonsense");
}

TEST(BadRays, MachinesWithoutAGpu) {
  const ProgramResult result =
      run_program({.arguments = {"trace", "--engine", "gpu"},
                   .input = kGood + "\n",
                   .environment = {{"VK_ICD_FILENAMES", "/nonexistent"}, {"VK_DRIVER_FILES", "/nonexistent"}}});
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(result.err.starts_with("vergence: --device: ")) << result.err;
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
}

TEST(BadRays, AnOutputThatTakesNothing) {
  std::string many;
  for (int i = 0; i < 1000; ++i) {
    many += kGood + "\n";
  }
  const ProgramResult result = run_program({.arguments = {"trace"}, .input = many, .standard_output = "/dev/full"});
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(result.err, "vergence: standard output: cannot be written\n");
}

// The lens that a line names lies beside the file of lines, wherever the program runs.
TEST(BadRays, LensFilesAreFoundBesideTheInput) {
  const support::TemporaryFolder folder;
  folder.write("lens.json", R"({"index": 1.5, "centre_thickness_mm": 2, "diameter_mm": 65,
      "front": {"type": "sphere", "radius_mm": 100}, "back": {"type": "sphere", "radius_mm": 100}})");
  folder.write("cut.json", R"({"index": 1.5, "front": {"type")");
  const std::string input = folder.write("rays.jsonl", R"({"id": 1, "lens_file": "lens.json", "direction": [0, 0, -1]}
{"id": 2, "lens_file": "cut.json", "direction": [0, 0, -1]}
{"id": 3, "lens_file": "lens.json", "direction": [0, 0.1, -1]}
)");
  const ProgramResult result = run_program({.arguments = {"trace", "--input", input}, .folder = "/"});
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_TRUE(result.err.starts_with("vergence: " + input + ": 1 of 3 lines")) << result.err;
  const auto answers = lines_of(result.out);
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(json::parse(answers[0])["status"], "ok");
  EXPECT_NE(json::parse(answers[1])["error"].get<std::string>().find("cut.json"), std::string::npos);
  EXPECT_EQ(json::parse(answers[2])["status"], "ok");
}

}  // namespace
