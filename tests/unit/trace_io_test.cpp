// The trace command's lines: requests in, results and errors out.
#include "lenses/lens_io/trace_io.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "lenses/lens_io/lens_io.hpp"
#include "tracking/input_error.hpp"

namespace {

using lenses::TraceRequest;
using nlohmann::json;
using tracking::InputError;

const char* const kLens =
    R"({"index": 1.5, "centre_thickness_mm": 2, "diameter_mm": 60, "front": {"type": "sphere", "radius_mm": 90},
        "back": {"type": "plane"}})";

TraceRequest parse(const std::string& line) {
  return lenses::parse_trace_line(line, "rays.jsonl", 3, ".");
}

void expect_refused(const std::string& line, const std::string& field, const std::string& reason) {
  try {
    (void)parse(line);
    ADD_FAILURE() << line << " was read; expected an error at " << field;
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), "rays.jsonl");
    EXPECT_EQ(error.field(), field) << error.what();
    EXPECT_NE(error.reason().find(reason), std::string::npos) << error.reason() << "\nlacks: " << reason;
  }
}

std::vector<json> case_lines() {
  std::vector<json> lines;
  for (const char* name : {"/optics-cases.jsonl", "/viewing-cases.jsonl"}) {
    std::ifstream file(std::string(VERGENCE_TEST_DATA) + name);
    for (std::string line; std::getline(file, line);) lines.push_back(json::parse(line));
  }
  return lines;
}

TEST(TraceReader, ReadsEveryCase) {
  const std::vector<json> cases = case_lines();
  ASSERT_EQ(cases.size(), 140u);
  for (const json& c : cases) {
    const json& input = c.at("input");
    TraceRequest request;
    ASSERT_NO_THROW(request = parse(input.dump())) << input.at("id");
    EXPECT_EQ(json::parse(request.id_json), input.at("id"));
    EXPECT_EQ(request.lens.has_value(), !input.at("lens").is_null());
    EXPECT_EQ(request.object_distance.has_value(), !input.at("object_distance_m").is_null());
    EXPECT_DOUBLE_EQ(request.eye.pupil_diameter.value() * 1e3, input.at("eye").at("pupil_diameter_mm").get<double>());
    EXPECT_EQ(request.side == lenses::Side::left, input.at("side") == "left");
    if (request.lens) {
      const std::string written = lenses::to_json(*request.lens);
      EXPECT_EQ(lenses::to_json(lenses::parse_lens(written, "f.json")), written) << input.at("id");
    }
  }
}

TEST(TraceReader, Defaults) {
  const TraceRequest request = parse(R"({"direction": [0, 0, -1]})");
  EXPECT_EQ(request.id_json, "null");
  EXPECT_FALSE(request.lens);
  EXPECT_FALSE(request.object_distance);
  EXPECT_EQ(request.side, lenses::Side::right);
  EXPECT_EQ(request.viewing, TraceRequest::Viewing::fixed);
  EXPECT_EQ(request.direction, glm::dvec3(0, 0, -1));
  EXPECT_EQ(request.eye.axial_length, 0.025);
  EXPECT_FALSE(request.eye.pupil_diameter);
}

TEST(TraceReader, KeepsTheId) {
  EXPECT_EQ(parse(R"({"id": "a \"b\"\n", "direction": [0, 0, -1]})").id_json, R"("a \"b\"\n")");
  EXPECT_EQ(parse(R"({"id": 18446744073709551615, "direction": [0, 0, -1]})").id_json, "18446744073709551615");
  EXPECT_EQ(parse(R"({"id": -7, "direction": [0, 0, -1]})").id_json, "-7");
  EXPECT_EQ(parse(R"({"id": 0.1, "direction": [0, 0, -1]})").id_json, "0.1");
  EXPECT_EQ(parse(R"({"id": null, "direction": [0, 0, -1]})").id_json, "null");
  expect_refused(R"({"id": [1], "direction": [0, 0, -1]})", "line 3: id", "a string, a number or null");
}

// An answer to a bad line carries the line's id where one can be found.
TEST(TraceReader, FindsTheIdOfABadLine) {
  EXPECT_EQ(lenses::trace_line_id(R"({"id": "x", "lens": {"a": [1, {"id": "inner"}]}, "bad": 1})"), "\"x\"");
  EXPECT_EQ(lenses::trace_line_id(R"({"lens": {"id": "inner"}})"), "null");
  EXPECT_EQ(lenses::trace_line_id(R"({"id": {"a": 1}})"), "null");
  EXPECT_EQ(lenses::trace_line_id(R"({"id": "x")"), "null");
  EXPECT_EQ(lenses::trace_line_id("[1]"), "null");
  EXPECT_EQ(lenses::trace_line_id("{\"id\": 5, \"a\": " + std::string(100000, '[') + std::string(100000, ']') + "}"),
            "5");
  EXPECT_EQ(lenses::trace_line_id(std::string(1000000, '[')), "null");
}

// Directions have any length; a power of two brings them near 1 without changing where they point.
TEST(TraceReader, ScalesDirectionsExactly) {
  const glm::dvec3 unit = parse(R"({"direction": [0.25, -0.5, -1]})").direction;
  EXPECT_EQ(unit, glm::dvec3(0.25, -0.5, -1.0));
  const glm::dvec3 large = parse(R"({"direction": [1e307, 0, -1e308]})").direction;
  EXPECT_EQ(large.x / large.z, -1e307 / 1e308);
  EXPECT_TRUE(std::abs(large.z) >= 1.0 && std::abs(large.z) < 2.0);
  const glm::dvec3 small = parse(R"({"direction": [0, 0, -4e-320]})").direction;
  EXPECT_TRUE(std::abs(small.z) >= 1.0 && std::abs(small.z) < 2.0);
}

TEST(TraceReader, NamesLineAndField) {
  const std::string good = std::string(R"("direction": [0, 0, -1], "lens": )") + kLens;
  EXPECT_NO_THROW((void)parse("{" + good + "}"));
  expect_refused("{}", "line 3: direction", "is missing; must be [x, y, z]");
  expect_refused("7", "line 3", "is 7; must be an object");
  expect_refused("{\"id\": 1,}", "line 3", "column 10: not valid JSON");
  expect_refused("", "line 3", "not valid JSON");
  expect_refused(R"({"id": 1, "id": 2})", "line 3: id", "is given twice");
  expect_refused(std::string(100000, '['), "line 3", "nested too deeply");
  expect_refused(R"({"direction": [0, 0, 0]})", "line 3: direction", "has no length");
  expect_refused(R"({"direction": [0, 0]})", "line 3: direction", "an array of 3 numbers");
  expect_refused(R"({"direction": [0, 0, "x"]})", "line 3: direction[2]", "must be a number");
  expect_refused(R"({"direction": [0, 0, 1e999]})", "line 3: direction[2]", "not a finite number");
  expect_refused("{" + good + R"(, "side": "both"})", "line 3: side", "one of \"right\" \"left\"");
  expect_refused("{" + good + R"(, "viewing": "stare"})", "line 3: viewing", "\"fixed\" \"scanning\" \"gaze\"");
  expect_refused("{" + good + R"(, "viewing": "gaze"})", "line 3: gaze", "as viewing is \"gaze\"");
  expect_refused("{" + good + R"(, "object_distance_m": 0})", "line 3: object_distance_m",
                 "is 0; must be a number from");
  expect_refused("{" + good + R"(, "object_distance_m": -1})", "line 3: object_distance_m", "is -1");
  expect_refused("{" + good + R"(, "gazes": 1})", "line 3: gazes",
                 "is an unknown key; allowed: id, lens, lens_file, eye");
  expect_refused("{" + good + R"(, "eye": {"age": 3}})", "line 3: eye.age", "is an unknown key");
  expect_refused("{" + good + R"(, "version": 2})", "line 3: version", "is 2, newer");
  expect_refused("{" + good + R"(, "lens_file": "a.json"})", "line 3: lens_file", "beside lens");
  expect_refused(R"({"direction": [0, 0, -1], "lens": {"index": 9}})", "line 3: lens.index", "is 9");
  expect_refused(R"({"direction": [0, 0, -1], "lens_file": ""})", "line 3: lens_file", "not empty");
  expect_refused(R"({"direction": [0, 0, -1], "lens_file": "a\u0000b"})", "line 3: lens_file", "control characters");
  expect_refused(R"({"direction": [0, 0, -1], "lens_file": "absent.json"})", "line 3: lens_file",
                 "./absent.json: cannot be read");
}

class LensFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / "vergence_trace_io_test";
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "lens.json") << kLens;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(LensFiles, AreFoundBesideTheInput) {
  const std::string line = R"({"direction": [0, 0, -1], "lens": null, "lens_file": "lens.json"})";
  const TraceRequest request = lenses::parse_trace_line(line, "rays.jsonl", 1, folder_.string());
  ASSERT_TRUE(request.lens);
  EXPECT_EQ(request.lens->index, 1.5);
}

TEST_F(LensFiles, AreReadOnce) {
  lenses::LensCache cache(folder_.string());
  const lenses::Lens& first = cache.read("lens.json");
  std::filesystem::remove(folder_ / "lens.json");
  EXPECT_EQ(&cache.read("lens.json"), &first);
  EXPECT_EQ(cache.read((folder_ / "lens.json").string()).index, 1.5) << "an absolute path is the same file";
  EXPECT_THROW((void)cache.read("other.json"), InputError);
}

TEST_F(LensFiles, NameTheirOwnFieldInsideTheLines) {
  std::ofstream(folder_ / "bad.json") << R"({"index": 0})";
  try {
    (void)lenses::parse_trace_line(R"({"direction": [0, 0, -1], "lens_file": "bad.json"})", "rays.jsonl", 2,
                                   folder_.string());
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), "rays.jsonl");
    EXPECT_EQ(error.field(), "line 2: lens_file");
    EXPECT_NE(error.reason().find("bad.json: index: is 0; must be"), std::string::npos) << error.reason();
  }
}

lenses::TraceResult measured() {
  lenses::TraceResult result;
  result.vergence = {1.0 / 3.0, -0.1, 2e-300};
  result.power = 0.1 + 0.2;
  result.astigmatism = 5.0;
  result.axis_deg = 179.99999999999997;
  result.back_hit = {0.001, 0.002, -0.016};
  result.front_hit = {0.0011, 0.0021, -0.018};
  result.object_direction = {0.0, 0.6, -0.8};
  result.deviation = std::numbers::pi / 7.0;
  result.accommodation = 1e22;
  result.residual = {-0.0, 1.0, 1e-7};
  result.blur = {0.01, 0.0};
  return result;
}

TEST(TraceWriter, KeepsEveryBit) {
  const lenses::TraceResult result = measured();
  const std::string line = lenses::format_trace_result("\"r1\"", result);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const json read = json::parse(line);
  EXPECT_EQ(read.at("id"), "r1");
  EXPECT_EQ(read.at("status"), "ok");
  EXPECT_EQ(read.at("vergence_D"), json({1.0 / 3.0, -0.1, 2e-300}));
  EXPECT_EQ(read.at("power_D"), 0.1 + 0.2);
  EXPECT_EQ(read.at("axis_deg"), 179.99999999999997);
  EXPECT_EQ(read.at("deviation_rad"), std::numbers::pi / 7.0);
  EXPECT_EQ(read.at("accommodation_D"), 1e22);
  EXPECT_EQ(read.at("blur_rad"), json({0.01, 0.0}));
  EXPECT_TRUE(read.at("blur_axis_deg").is_null());
  EXPECT_EQ(read.at("front_hit_m").at(2), -0.018);
  EXPECT_EQ(read.size(), 14u);
  EXPECT_NE(line.find("\"residual_D\": [-0, 1, 1e-07]"), std::string::npos) << "the shortest text\n" << line;
}

TEST(TraceWriter, LeavesTheBareEyeWithoutHits) {
  lenses::TraceResult result = measured();
  result.has_lens = false;
  const json read = json::parse(lenses::format_trace_result("3", result));
  EXPECT_TRUE(read.at("back_hit_m").is_null());
  EXPECT_TRUE(read.at("front_hit_m").is_null());
  EXPECT_FALSE(read.at("object_direction").is_null());
}

TEST(TraceWriter, WritesOnlyTheStatusUnlessOk) {
  for (const auto status : {lenses::RayStatus::miss_back, lenses::RayStatus::miss_front, lenses::RayStatus::tir_front,
                            lenses::RayStatus::inverted, lenses::RayStatus::singular}) {
    lenses::TraceResult result = measured();
    result.status = status;
    const json read = json::parse(lenses::format_trace_result("null", result));
    EXPECT_EQ(read.at("status"), lenses::name(status));
    EXPECT_EQ(read.size(), 14u);
    for (const auto& [key, value] : read.items()) {
      EXPECT_TRUE(key == "status" || value.is_null()) << key;
    }
  }
}

TEST(TraceWriter, NeverWritesNanOrInfinity) {
  lenses::TraceResult result = measured();
  result.vergence = {NAN, INFINITY, -INFINITY};
  result.blur_axis_deg = NAN;
  const json read = json::parse(lenses::format_trace_result("1", result));
  EXPECT_EQ(read.at("vergence_D"), json({nullptr, nullptr, nullptr}));
  EXPECT_TRUE(read.at("blur_axis_deg").is_null());
}

TEST(TraceWriter, EscapesErrors) {
  const json read = json::parse(lenses::format_trace_error("\"a\"", "bad \"x\"\n\xff"));
  EXPECT_EQ(read, json({{"id", "a"}, {"error", "bad \"x\"\n\xEF\xBF\xBD"}}));
}

// Bytes of good lines flipped or removed: a line is read or refused by InputError, and always has an id to answer to.
TEST(TraceReader, SurvivesDamage) {
  const unsigned seed = 99;
  std::mt19937 random(seed);
  const std::vector<json> cases = case_lines();
  for (int i = 0; i < 5000; ++i) {
    std::string line = cases[random() % cases.size()].at("input").dump();
    // Mostly near the end: the nets in front of it make up nearly all of a spline's line.
    const std::size_t reach = std::min<std::size_t>(line.size(), 1200);
    for (auto n = 1 + random() % 3; n > 0; --n) {
      const std::size_t at = line.size() - 1 - random() % std::min(reach, line.size());
      if (random() % 2 == 0) {
        line[at] = static_cast<char>(line[at] ^ (1 << random() % 8));
      } else {
        line.erase(at, 1 + random() % 4);
      }
    }
    try {
      (void)parse(line);
    } catch (const InputError& error) {
      EXPECT_EQ(error.field().rfind("line 3", 0), 0u) << error.what();
    } catch (const std::exception& error) {
      FAIL() << "seed " << seed << ", round " << i << ": " << error.what() << "\n" << line;
    }
    EXPECT_TRUE(json::accept(lenses::format_trace_error(lenses::trace_line_id(line), line))) << line;
  }
}

}  // namespace
