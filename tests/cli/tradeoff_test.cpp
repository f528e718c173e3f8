// vergence tradeoff as a user starts it: tiny pictures of two patches of light, their files, the kept reference, and
// the options it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "render/image/png.hpp"
#include "render/ladder.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/tiny_scene.hpp"

namespace {

using nlohmann::json;

// A small thing in the near and a wall far behind it, so that one of them is out of focus: a dioptre of the default
// pupil is 6 arcmin, half a pixel of these pictures.
std::string scene_text() {
  return support::patch_gltf({support::wall(6.0F, 3.0F, 0.4F),
                              {{-0.006F, -0.005F, -0.4F}, {0.01F, 0.0F, 0.0F}, {0.0F, 0.01F, 0.0F}, 0.9F}},
                             {{"patch", {-0.001F, 0.0F, -0.4F}}})
      .text();
}

std::vector<std::vector<std::string>> table_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> cells;
    std::istringstream words(line);
    for (std::string cell; std::getline(words, cell, ',');) {
      cells.push_back(cell);
    }
    rows.push_back(cells);
  }
  return rows;
}

// Rows stand in the ladder's order, whatever order was asked for.
std::vector<std::string> settings_in_order(const std::vector<std::string>& wanted) {
  std::vector<std::string> names;
  for (const render::Rung& rung : render::ladder()) {
    if (std::ranges::find(wanted, rung.name) != wanted.end()) {
      names.emplace_back(rung.name);
    }
  }
  return names;
}

class Tradeoff : public testing::Test {
 protected:
  support::ProgramResult run(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"tradeoff", "--scene", scene_, "--size", "24x20", "--fov", "4"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return support::run_program({.arguments = arguments,
                                 .environment = {{"XDG_CACHE_HOME", (folder_.path() / "cache").string()}},
                                 .time_limit = std::chrono::seconds(400)});
  }
  [[nodiscard]] std::filesystem::path kept_reference() const {
    const auto files = std::filesystem::directory_iterator(folder_.path() / "cache" / "vergence" / "references");
    return begin(files)->path();
  }

  support::TemporaryFolder folder_;
  std::string scene_ = folder_.write("patches.gltf", scene_text());
};

TEST_F(Tradeoff, WritesWhatTheContractNamesAndKeepsItsReference) {
  const std::string report = (folder_.path() / "report").string();
  const std::vector<std::string> settings{"standard",     "pinhole", "vis",   "half-resolution", "lens-2-iterations",
                                          "foveated-5-4", "dof-1",   "dof-4", "dof-64"};
  std::string list;
  for (const std::string& setting : settings) {
    list += (list.empty() ? "" : ",") + setting;
  }
  const std::string spectacles = VERGENCE_ASSETS "/spectacles/presbyopia_bspline_sphere.json";
  const std::string wearer = VERGENCE_ASSETS "/wearers/presbyopia.json";
  const std::vector<std::string> who{"--wearer", wearer, "--spectacles", spectacles};
  std::vector<std::string> options{"--settings", list,       "--rounds", "1",     "--reference-samples",
                                   "512",        "--output", report,     "--json"};
  options.insert(options.end(), who.begin(), who.end());
  const auto first = run(options);
  ASSERT_EQ(first.exit_status, 0) << first.err;
  const json j = json::parse(first.out);
  EXPECT_FALSE(j["reference"]["from_cache"].get<bool>());
  EXPECT_TRUE(j["left_out"].empty()) << j["left_out"];
  ASSERT_EQ(j["rows"].size(), settings.size());
  std::map<std::string, json> rows;
  for (const json& row : j["rows"]) {
    rows[row["setting"]] = row;
    EXPECT_GT(row["time_ms"].get<double>(), 0.0);
    EXPECT_LE(row["time_ms_min"].get<double>(), row["time_ms"].get<double>());
    EXPECT_LE(row["time_ms"].get<double>(), row["time_ms_max"].get<double>());
    EXPECT_EQ(row["rmse"].is_null(), row["setting"] == "vis") << row;
    EXPECT_GE(row["power_error_D_p99"].get<double>(), 0.0);
    EXPECT_GE(row["astigmatism_error_D_p99"].get<double>(), 0.0);
  }
  const auto rmse = [&](const char* setting) { return rows.at(setting)["rmse"].get<double>(); };
  EXPECT_LT(rmse("dof-64"), rmse("dof-4"));
  EXPECT_LT(rmse("dof-4"), rmse("dof-1"));
  EXPECT_LT(rmse("standard"), rmse("pinhole"));
  EXPECT_EQ(rows.at("dof-64")["samples"], 64);
  // Nothing beats a row of the line.
  for (const auto& [name, row] : rows) {
    for (const auto& [other_name, other] : rows) {
      if (row["efficient"].get<bool>() && name != other_name && !other["rmse"].is_null()) {
        EXPECT_FALSE(other["time_ms"] < row["time_ms"] && other["rmse"] < row["rmse"]) << other_name << " " << name;
      }
    }
  }
  EXPECT_GT(j["dof_for_target"]["samples"].get<double>(), 0.0);
  EXPECT_FALSE(j["advice"].empty());

  const std::filesystem::path folder(report);
  const auto table = table_of(folder / "tradeoff.csv");
  ASSERT_EQ(table.size(), settings.size() + 1);
  const std::vector<std::string> columns{"setting",     "samples",           "time_ms",
                                         "time_ms_min", "time_ms_max",       "rmse",
                                         "psnr_db",     "power_error_D_p99", "astigmatism_error_D_p99"};
  EXPECT_EQ(std::vector(table[0].begin(), table[0].begin() + 9), columns);
  for (std::size_t i = 1; i < table.size(); ++i) {
    EXPECT_EQ(table[i][0], settings_in_order(settings)[i - 1]);
    for (std::size_t c = 1; c < 9; ++c) {
      if (!table[i][c].empty()) {
        EXPECT_TRUE(std::isfinite(std::stod(table[i][c]))) << table[0][c];
      }
    }
  }
  EXPECT_EQ(render::read_png(folder / "picture_reference.png").width, 24);
  EXPECT_GT(render::read_png(folder / "tradeoff.png").width, 500);
  for (const char* file : {"tradeoff.svg", "report.html", "picture_vis.png", "difference_dof-4.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  }

  // Again: the reference is found, and the errors are the same; damaged, it is computed again, the same once more.
  std::vector<std::string> again{"--settings", "standard", "--rounds", "1", "--reference-samples", "512", "--json"};
  again.insert(again.end(), who.begin(), who.end());
  const json second = json::parse(run(again).out);
  EXPECT_TRUE(second["reference"]["from_cache"].get<bool>());
  EXPECT_EQ(second["rows"][0]["rmse"], rows.at("standard")["rmse"]);
  std::fstream(kept_reference(), std::ios::in | std::ios::out | std::ios::binary).seekp(-5, std::ios::end).put('x');
  const json third = json::parse(run(again).out);
  EXPECT_FALSE(third["reference"]["from_cache"].get<bool>());
  EXPECT_EQ(third["rows"][0]["rmse"], rows.at("standard")["rmse"]);
  EXPECT_TRUE(json::parse(run(again).out)["reference"]["from_cache"].get<bool>()) << "and kept anew";
}

TEST_F(Tradeoff, TakesBothEyesTwoPairsAndAHeadset) {
  const std::string spectacles = VERGENCE_ASSETS "/spectacles/myopia.json";
  const auto result =
      run({"--eye", "both", "--compare", spectacles, "--headset", VERGENCE_ASSETS "/headsets/example.json",
           "--settings", "standard,dof-4,half-resolution", "--rounds", "1", "--reference-samples", "16",
           "--target-error", "0.02", "--look-at", "patch"});
  ASSERT_EQ(result.exit_status, 0) << result.err;
  EXPECT_NE(result.out.find("48x20"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("For an error of 0.02"), std::string::npos) << result.out;
}

TEST_F(Tradeoff, RefusesWhatItDoesNotKnow) {
  const std::vector<std::vector<std::string>> bad{{"--settings", "best"},
                                                  {"--settings", "standard,,pinhole"},
                                                  {"--settings", "pinhole", "--mode", "dof"},
                                                  {"--mode", "blur"},
                                                  {"--size", "0x5"},
                                                  {"--rounds", "0"},
                                                  {"--reference-samples", "1"},
                                                  {"--target-error", "0"},
                                                  {"--accuracy", "most"},
                                                  {"--exposure", "99"},
                                                  {"--output", "/proc/none/x"},
                                                  {"--spectacles", "/none.json"},
                                                  {"--look-at", "nobody"},
                                                  {"--eye", "third"}};
  for (const auto& options : bad) {
    const auto result = run(options);
    EXPECT_EQ(result.exit_status, 2) << options[0] << " " << options[1] << ": " << result.err;
    const std::string at_fault = options[0] == "--spectacles" ? options[1] : options[0];
    EXPECT_TRUE(result.err.starts_with("vergence: " + at_fault)) << result.err;
    EXPECT_TRUE(result.out.empty());
  }
}

// A run that fails leaves no folder behind.
TEST_F(Tradeoff, LeavesNothingWhenItFails) {
  const std::filesystem::path report = folder_.path() / "report";
  const auto result = run({"--output", report.string(), "--device", "no such device"});
  EXPECT_EQ(result.exit_status, 1) << result.err;
  EXPECT_FALSE(std::filesystem::exists(report));
}

}  // namespace
