// vergence lens progressive: a lens file and a report for good options; one line and no file for bad ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lenses/lens_io/lens_io.hpp"
#include "tests/support/run_program.hpp"

namespace {

using nlohmann::json;
using support::ProgramResult;
using support::run_program;
using support::TemporaryFolder;
using Words = std::vector<std::string>;

class LensProgressive : public testing::Test {
 protected:
  [[nodiscard]] std::string output() const { return (folder_.path() / "lens.json").string(); }

  [[nodiscard]] ProgramResult run(const Words& more) const {
    Words words{"lens", "progressive"};
    if (std::ranges::find(more, "--output") == more.end()) {
      words.insert(words.end(), {"--output", output()});
    }
    if (std::ranges::find(more, "--grid") == more.end()) {
      words.insert(words.end(), {"--grid", "30"});
    }
    words.insert(words.end(), more.begin(), more.end());
    return run_program({.arguments = words});
  }

  void expect_refused(const Words& more, const std::string& what, int status = 2) {
    const ProgramResult result = run(more);
    SCOPED_TRACE(more.empty() ? "" : more.front() + " " + more.back());
    EXPECT_EQ(result.exit_status, status);
    EXPECT_EQ(result.signal, 0);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with("vergence: " + what + ": ")) << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_TRUE(folder_.names().empty());
  }

  TemporaryFolder folder_;
};

TEST_F(LensProgressive, WritesTheLensAndReportsIt) {
  const ProgramResult result = run({"--add", "2.5", "--distance-power", "-3.25", "--corridor", "12", "--inset", "2",
                                    "--side", "left", "--eye-side", "--index", "1.67", "--abbe", "31"});
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("peak cylinder"), std::string::npos);
  const lenses::Lens lens = lenses::read_lens(output());
  EXPECT_EQ(lens.index, 1.67);
  EXPECT_EQ(lens.abbe, 31.0);
  EXPECT_TRUE(std::holds_alternative<lenses::BsplineHeightField>(lens.back));
  EXPECT_NEAR(lens.reference_points.near->x, 0.002, 1e-15);
  EXPECT_NEAR(lens.reference_points.near->y, 0.004 - 0.012, 1e-15);
  ASSERT_TRUE(lens.order);
  EXPECT_EQ(lens.order->ordered.sphere, -3.25);
  EXPECT_EQ(lens.order->ordered.addition, 2.5);
}

TEST_F(LensProgressive, TheReportAsJson) {
  for (const std::string method : {"closed-form", "variational"}) {
    const ProgramResult result = run({"--method", method, "--json"});
    ASSERT_EQ(result.exit_status, 0) << result.err;
    const json report = json::parse(result.out);
    EXPECT_EQ(report.at("method"), method);
    EXPECT_EQ(report.at("surface"), "front");
    EXPECT_NEAR(report.at("lensmeter").at("addition_D").get<double>(), 2.0, 2e-3);
    EXPECT_NEAR(report.at("surface_power").at("addition_D").get<double>(), 2.0, 0.05);
    EXPECT_EQ(report.at("clear_widths").size(), 3U);
    EXPECT_GT(report.at("peak_cylinder_D").get<double>(), 1.0);
    EXPECT_NEAR(report.at("minkwitz").at("ratio").get<double>(), 1.0, 0.1);
  }
}

TEST_F(LensProgressive, TheSameOrderMakesTheSameFile) {
  ASSERT_EQ(run({}).exit_status, 0);
  const lenses::Lens first = lenses::read_lens(output());
  ASSERT_EQ(run({}).exit_status, 0);
  EXPECT_EQ(lenses::read_lens(output()), first);
}

TEST_F(LensProgressive, RefusesWhatIsOutOfRange) {
  expect_refused({"--add", "0.5"}, "--add");
  expect_refused({"--add", "nan"}, "--add");
  expect_refused({"--add", "much"}, "--add");
  expect_refused({"--corridor", "7"}, "--corridor");
  expect_refused({"--inset", "-1"}, "--inset");
  expect_refused({"--hardness", "1.5"}, "--hardness");
  expect_refused({"--index", "1"}, "--index");
  expect_refused({"--abbe", "0"}, "--abbe");
  expect_refused({"--distance-power", "40"}, "--distance-power");
  expect_refused({"--base-curve", "inf"}, "--base-curve");
  expect_refused({"--diameter", "30"}, "--diameter");
  expect_refused({"--distance-power", "9", "--diameter", "75"}, "--diameter");
  expect_refused({"--centre-thickness", "1.3"}, "--centre-thickness");
  expect_refused({"--grid", "1000000"}, "--grid");
  expect_refused({"--grid", "-5"}, "--grid");
  expect_refused({"--method", "magic"}, "--method");
  expect_refused({"--side", "middle"}, "--side");
  expect_refused({"--add", ""}, "--add");
}

TEST_F(LensProgressive, LeavesNothingWhereItCannotWrite) {
  const std::string nowhere = (folder_.path() / "missing" / "lens.json").string();
  expect_refused({"--output", nowhere}, nowhere, 1);
}

}  // namespace
