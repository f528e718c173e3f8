// vergence measure as a user starts it: what it prints and writes, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "render/image/png.hpp"
#include "tests/support/run_program.hpp"

namespace {

using nlohmann::json;
using support::run_program;
using Words = std::vector<std::string>;

const std::string kProgressive = std::string(VERGENCE_ASSETS) + "/lenses/progressive_add200_right.json";
const std::string kAstigmatic = std::string(VERGENCE_ASSETS) + "/spectacles/astigmatism.json";

Words measure(const Words& more) {
  Words words{"measure"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  EXPECT_TRUE(stream.good()) << file;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

const json& reading(const json& report, const std::string& point, const std::string& surface) {
  for (const json& r : report.at("readings")) {
    if (r.at("point") == point && r.at("surface") == surface) {
      return r;
    }
  }
  ADD_FAILURE() << "no reading " << point << " " << surface;
  return report;
}

TEST(Measure, PrintsReadingsAndVerdictAsJson) {
  const auto result = run_program({.arguments = measure({"--lens", kProgressive, "--add", "2", "--json"})});
  ASSERT_EQ(result.exit_status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const json report = json::parse(result.out);
  EXPECT_EQ(report["class"], "progressive");
  EXPECT_EQ(report["addition_surface"], "front");
  EXPECT_NEAR(report["addition_D"].get<double>(), 1.995, 0.02);
  EXPECT_NEAR(reading(report, "distance", "back")["sphere_D"].get<double>(), 0.0, 0.01);
  EXPECT_EQ(report["verdict"]["standard"], "ANSI Z80.1-2015");
  EXPECT_EQ(report["verdict"]["against"], "ordered");
  EXPECT_TRUE(report["verdict"]["pass"].get<bool>());
  for (const json& check : report["verdict"]["checks"]) {
    EXPECT_LE(std::abs(check["difference"].get<double>()), check["limit"].get<double>());
  }
}

// The keys of an object are those its schema requires, and no others are allowed.
void expect_keys(const json& object, const json& schema) {
  std::set<std::string> given, required;
  for (const auto& [key, value] : object.items()) {
    given.insert(key);
  }
  for (const json& key : schema.at("required")) {
    required.insert(key.get<std::string>());
  }
  EXPECT_EQ(given, required);
  EXPECT_EQ(schema.at("additionalProperties"), false);
}

TEST(Measure, JsonHasTheKeysOfItsSchema) {
  const json schema = json::parse(text_of(std::string(VERGENCE_ASSETS) + "/schemas/measure-output.schema.json"));
  const auto result = run_program({.arguments = measure({"--lens", kProgressive, "--add", "2", "--json"})});
  const json report = json::parse(result.out);
  expect_keys(report, schema);
  expect_keys(report["thickness_mm"], schema["properties"]["thickness_mm"]);
  expect_keys(report["readings"][0], schema["$defs"]["reading"]);
  expect_keys(report["verdict"], schema["$defs"]["verdict"]);
  expect_keys(report["verdict"]["checks"][0], schema["$defs"]["check"]);
}

TEST(Measure, BothCylinderFormsAreOneLens) {
  const Words pair{"--spectacles", kAstigmatic, "--json", "--cylinder-form"};
  const auto form = [&](const std::string& name) {
    Words words = pair;
    words.push_back(name);
    const auto result = run_program({.arguments = measure(words)});
    EXPECT_EQ(result.exit_status, 0) << result.err;
    return reading(json::parse(result.out), "distance", "back");
  };
  const json minus = form("minus"), plus = form("plus");
  // The file's radii are rounded to 0.1 um: 3e-5 D.
  EXPECT_NEAR(minus["sphere_D"].get<double>(), -1.0, 1e-4);
  EXPECT_NEAR(minus["cylinder_D"].get<double>(), -2.5, 1e-4);
  EXPECT_NEAR(minus["axis_deg"].get<double>(), 20.0, 1e-3);
  EXPECT_NEAR(plus["sphere_D"].get<double>(), -3.5, 1e-4);
  EXPECT_NEAR(plus["cylinder_D"].get<double>(), 2.5, 1e-4);
  EXPECT_NEAR(plus["axis_deg"].get<double>(), 110.0, 1e-3);
}

TEST(Measure, SaysThatThereIsNoVerdictWithoutAnOrder) {
  const auto table = run_program({.arguments = measure({"--spectacles", kAstigmatic, "--side", "left"})});
  ASSERT_EQ(table.exit_status, 0) << table.err;
  EXPECT_NE(table.out.find("No verdict"), std::string::npos) << table.out;
  const auto report = run_program({.arguments = measure({"--spectacles", kAstigmatic, "--json"})});
  EXPECT_TRUE(json::parse(report.out)["verdict"].is_null());
}

TEST(Measure, AnOrderByHandIsJudgedByTheNamedStandard) {
  const Words order{"--spectacles", kAstigmatic, "--sphere", "-1",     "--cylinder", "-2.25",          "--axis",
                    "23",           "--prism",   "0.5@up",   "--json", "--standard", "ansi z80.1-2015"};
  const auto result = run_program({.arguments = measure(order)});
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const json verdict = json::parse(result.out)["verdict"];
  EXPECT_FALSE(verdict["pass"].get<bool>());
  const auto passes = [&](const std::string& tolerance) {
    const auto found =
        std::ranges::find_if(verdict["checks"], [&](const json& c) { return c["tolerance"] == tolerance; });
    return (*found)["pass"].get<bool>();
  };
  EXPECT_TRUE(passes("sphere"));
  EXPECT_FALSE(passes("cylinder")) << "0.25 D is more than 0.15 D";
  EXPECT_FALSE(passes("axis")) << "3 degrees are more than 2";
  EXPECT_FALSE(passes("prism")) << "0.5 pd are more than 0.33 pd, and than 1 mm of -3.36 D";
}

// A pair from prescriptions: each side is judged by its own order, and both together by their vertical prisms.
TEST(Measure, APairIsJudgedForItsVerticalImbalance) {
  const support::TemporaryFolder folder;
  const std::string pair = folder.write(
      "pair.json",
      R"({"name": "pair", "right": {"prescription": {"sphere": -2, "prism": [{"magnitude": 1, "base": 90}]}},
      "left": {"prescription": {"sphere": -3, "cylinder": -0.5, "axis": 10}}})");
  for (const char* side : {"right", "left"}) {
    const auto result = run_program({.arguments = measure({"--spectacles", pair, "--side", side, "--json"})});
    ASSERT_EQ(result.exit_status, 0) << result.err;
    const json verdict = json::parse(result.out)["verdict"];
    EXPECT_TRUE(verdict["pass"].get<bool>()) << result.out;
    const json& last = verdict["checks"].back();
    EXPECT_EQ(last["tolerance"], "vertical imbalance");
    EXPECT_NEAR(last["target"].get<double>(), side == std::string("right") ? 1.0 : -1.0, 1e-9);
    EXPECT_NEAR(last["difference"].get<double>(), 0.0, 0.01);
  }
}

TEST(Measure, WritesNumbersPicturesAndPage) {
  const support::TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / "new" / "report";
  const auto result = run_program(
      {.arguments = measure({"--lens", kProgressive, "--add", "2", "--grid", "21", "--output", out.string()})});
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const auto lines = [&](const std::string& file) {
    const std::string text = text_of(out / file);
    return std::ranges::count(text, '\n');
  };
  EXPECT_EQ(lines("readings.csv"), 1 + 5);
  EXPECT_EQ(lines("verdict.csv"), 1 + 4);
  EXPECT_EQ(lines("lens_map.csv"), 1 + 21 * 21);
  EXPECT_EQ(lines("worn_map.csv"), 1 + 21 * 21);
  // Every row of a table has the cells of its header.
  for (const char* file : {"readings.csv", "verdict.csv", "lens_map.csv", "worn_map.csv"}) {
    std::istringstream rows(text_of(out / file));
    std::string row;
    std::getline(rows, row);
    const auto cells = std::ranges::count(row, ',');
    while (std::getline(rows, row)) {
      EXPECT_EQ(std::ranges::count(row, ','), cells) << file << ": " << row;
    }
  }
  const std::string page = text_of(out / "report.html");
  for (const char* picture :
       {"power.png", "cylinder.png", "prism.png", "thickness.png", "worn_power.png", "worn_astigmatism.png",
        "working_power.png", "working_astigmatism.png", "worn_prism.png"}) {
    EXPECT_NO_THROW(static_cast<void>(render::read_png(out / picture))) << picture;
    EXPECT_NE(page.find(picture), std::string::npos) << picture;
  }
  EXPECT_NE(page.find("ANSI Z80.1-2015"), std::string::npos);
}

TEST(Measure, ALensThatCannotBeReadSaysWhy) {
  const support::TemporaryFolder folder;
  const std::string crossed = folder.write(
      "crossed.json", R"({"index": 1.5, "centre_thickness_mm": 0.1, "diameter_mm": 60, "front": {"type": "sphere",
      "radius_mm": 60}, "back": {"type": "plane"}, "reference_points_mm": {"distance": [0, 15]}})");
  const std::string out = (folder.path() / "out").string();
  const auto result =
      run_program({.arguments = measure({"--lens", crossed, "--sphere", "8", "--grid", "21", "--output", out})});
  ASSERT_EQ(result.exit_status, 0) << result.err;
  EXPECT_NE(result.out.find("no reading: inverted"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("NOT all passed"), std::string::npos) << result.out;
}

TEST(Measure, RefusesBadInputInOneLine) {
  const support::TemporaryFolder folder;
  const std::string broken = folder.write("broken.json", "{\"index\": 1.5,");
  const auto before = folder.names();
  struct Bad {
    Words words;
    std::string what;
  };
  const Words good{"--lens", kProgressive};
  const auto with = [&](const Words& more) {
    Words words = good;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::vector<Bad> cases{
      {{}, "--lens: is missing"},
      {{"--lens", kProgressive, "--spectacles", kAstigmatic}, "--"},
      {{"--lens", "nowhere.json"}, "nowhere.json: "},
      {{"--lens", broken}, broken + ": "},
      {{"--lens", kAstigmatic}, kAstigmatic + ": "},
      {{"--spectacles", kProgressive}, kProgressive + ": "},
      {with({"--side", "middle"}), "--side"},
      {with({"--standard", "ISO 1"}), "--standard: 'ISO 1' is not known; ANSI Z80.1-2015"},
      {with({"--grid", "10"}), "--grid: "},
      {with({"--grid", "100000"}), "--grid: "},
      {with({"--grid", "x"}), "--grid: "},
      {with({"--working-distance", "0"}), "--working-distance: "},
      {with({"--working-distance", "nan"}), "--working-distance: "},
      {with({"--field", "90"}), "--field: "},
      {with({"--sphere", "nan"}), "--sphere: "},
      {with({"--sphere", "1e9"}), "--sphere: "},
      {with({"--cylinder", "-1"}), "--axis: is missing"},
      {with({"--axis", "181"}), "--axis: "},
      {with({"--add", "-1"}), "--add: "},
      {with({"--prism", "1"}), "--prism: "},
      {with({"--prism", "1@sideways"}), "--prism: "},
      {with({"--prism", "1@361"}), "--prism: "},
      {with({"--prism", "99@0"}), "--prism: "},
      {with({"--class", "bifocal"}), "--class"},
      {with({"--cylinder-form", "both"}), "--cylinder-form"},
      {with({"--wearer", kProgressive}), kProgressive + ": "},
      {with({"--output", "/proc/none/x"}), "--output: "},
      {with({"--output", broken}), "--output: "},
  };
  for (const Bad& bad : cases) {
    const auto result = run_program({.arguments = measure(bad.words), .folder = folder.path()});
    EXPECT_EQ(result.exit_status, 2) << bad.what << ": " << result.err;
    EXPECT_EQ(result.out, "") << bad.what;
    EXPECT_TRUE(result.err.starts_with("vergence: " + bad.what)) << bad.what << ": " << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_EQ(folder.names(), before) << bad.what;
  }
}

}  // namespace
