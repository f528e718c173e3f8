// vergence lens from-prescription as its users call it: files and reports, and what is wrong in one line.
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

class LensFromPrescription : public testing::Test {
 protected:
  [[nodiscard]] ProgramResult run(const Words& more) const {
    Words words{"lens", "from-prescription", "--output", output()};
    words.insert(words.end(), more.begin(), more.end());
    return run_program({.arguments = words});
  }
  [[nodiscard]] std::string output() const { return (folder_.path() / "lens.json").string(); }

  [[nodiscard]] json report(Words words) const {
    words.push_back("--json");
    const ProgramResult result = run(words);
    EXPECT_EQ(result.exit_status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return json::parse(result.out, nullptr, false);
  }

  void refused(const Words& words, const std::string& option, const std::string& reason) const {
    std::string line;
    for (const std::string& word : words) line += " '" + word + "'";
    SCOPED_TRACE(line);
    const auto before = folder_.names();
    const ProgramResult result = run(words);
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.signal, 0);
    EXPECT_EQ(result.exit_status, 2) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with("vergence: " + option + ": ")) << "wanted " << option << ", got " << result.err;
    EXPECT_NE(result.err.find(reason), std::string::npos) << "wanted '" << reason << "' in: " << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_EQ(folder_.names(), before) << "left something behind";
  }

  TemporaryFolder folder_;
};

TEST_F(LensFromPrescription, WritesTheLensAndReportsAllThreePowers) {
  const ProgramResult result = run({"--sphere", "-2.25", "--cylinder", "-0.75", "--axis", "175", "--prism", "1@in",
                                    "--side", "right", "--material", "MR-8"});
  EXPECT_EQ(result.exit_status, 0) << result.err;
  for (const char* row : {"ordered         -2.25     -0.75  175.0      -   1.00@0.0\n",
                          "compensated     -2.25     -0.75  175.0      -   1.00@0.0\n", "as worn ",
                          "front       sphere", "back        torus", "thickness   centre 1.20 mm", "weight "}) {
    EXPECT_NE(result.out.find(row), std::string::npos) << row << "not in\n" << result.out;
  }
  const lenses::Lens lens = lenses::read_lens(output());
  EXPECT_EQ(lens.index, 1.6);
  ASSERT_TRUE(lens.order);
  EXPECT_EQ(lens.order->ordered.sphere, -2.25);
  EXPECT_FALSE(lens.order->compensated) << "the lensmeter reads the order";
}

TEST_F(LensFromPrescription, ReportsAsJson) {
  const json r = report({"--sphere", "-4", "--as-worn", "--panto", "12", "--wrap", "0", "--index", "1.7"});
  EXPECT_EQ(r.at("ordered").at("sphere"), -4.0);
  EXPECT_NEAR(r.at("as_worn").at("sphere").get<double>(), -4.0, 1e-6);
  EXPECT_GT(std::abs(r.at("compensated").at("cylinder").get<double>()), 0.05);
  EXPECT_EQ(r.at("index"), 1.7);
  EXPECT_TRUE(r.at("weight_g").is_null()) << "no density without a material";
  EXPECT_EQ(r.at("edge_thickness_mm").size(), 2U);
  const lenses::Lens lens = lenses::read_lens(output());
  ASSERT_TRUE(lens.order && lens.order->compensated);
  EXPECT_NEAR(lens.order->compensated->sphere, r.at("compensated").at("sphere").get<double>(), 1e-9);
}

TEST_F(LensFromPrescription, MakesEveryDesign) {
  EXPECT_TRUE(std::holds_alternative<lenses::BsplineHeightField>([&] {
    (void)report({"--sphere", "1", "--add", "2", "--thinning", "--corridor", "16"});
    return lenses::read_lens(output()).back;
  }()));
  for (const char* segment : {"ft28", "r24", "executive"}) {
    (void)report({"--sphere", "1", "--add", "2", "--design", "bifocal", "--segment", segment});
    EXPECT_TRUE(std::holds_alternative<lenses::SegmentedSurface>(lenses::read_lens(output()).front)) << segment;
  }
  (void)report({"--sphere", "-5", "--design", "contact", "--contact", "rigid"});
  EXPECT_EQ(lenses::read_lens(output()).attached_to, lenses::Lens::AttachedTo::eye);
  (void)report({"--sphere", "4", "--front", "aspheric", "--base-curve", "7"});
  EXPECT_TRUE(std::holds_alternative<lenses::Conic>(lenses::read_lens(output()).front));
}

TEST_F(LensFromPrescription, CutsToAnOutline) {
  const std::string outline =
      folder_.write("frame.json", R"({"polygon_mm": [[24, 15], [-20, 15], [-20, -15], [24, -15]]})");
  const json small = report({"--sphere", "5", "--outline", outline});
  const json round = report({"--sphere", "5"});
  EXPECT_LT(small.at("centre_thickness_mm").get<double>(), round.at("centre_thickness_mm").get<double>());
}

TEST_F(LensFromPrescription, RefusesWhatIsNoOrder) {
  refused({"--sphere", "x"}, "--sphere", "'x' is not a number");
  refused({"--sphere", "nan"}, "--sphere", "nan");
  refused({"--sphere", "41"}, "--sphere", "from -40 to 40 D");
  refused({"--cylinder", "-21", "--axis", "3"}, "--cylinder", "from -20 to 20 D");
  refused({"--cylinder", "-1"}, "--axis", "is missing");
  refused({"--cylinder", "-1", "--axis", "181"}, "--axis", "from 0 to 180");
  refused({"--cylinder", "-1", "--axis", "nan"}, "--axis", "from 0 to 180");
  refused({"--add", "2", "--design", "single_vision"}, "--add", "bifocal or progressive");
  refused({"--add", "-1"}, "--add", "from 0 to 6 D");
  for (const std::string prism :
       {"2", "2@", "@up", "x@up", "2@left", "2@up@down", "2@361", "2@-1", "nan@up", "2@nan"}) {
    refused({"--prism", prism}, "--prism", "'" + prism + "'");
  }
  refused({"--prism", "2@in"}, "--prism", "--side");
  refused({"--prism", "31@up"}, "--prism", "from 0 to 30");
  refused({"--prism", "20@up", "--prism", "20@up"}, "--prism", "in all");
  refused({"--side", "middle"}, "--side", "left");
  refused({"--design", "varifocal"}, "--design", "progressive");
  refused({"--material", "glass"}, "--material", "CR-39");
  refused({"--material", "CR-39", "--index", "1.5"}, "--material", "together with --index");
  refused({"--index", "1.2"}, "--index", "from 1.3 to 2.2");
  refused({"--material", ""}, "--material", "");
  refused({"--output", ""}, "--output", "");
  refused({"--nonsense"}, "--nonsense", "not an option of vergence lens from-prescription");
  refused({"extra"}, "extra", "takes options only");
}

TEST_F(LensFromPrescription, RefusesWhatNoLensCanBe) {
  refused({"--sphere", "12", "--diameter", "90"}, "--diameter", "at most 49.8 mm is possible");
  refused({"--sphere", "12", "--centre-thickness", "3"}, "--centre-thickness", "at least");
  refused({"--sphere", "0.25", "--prism", "2@up", "--prism-by", "decentration"}, "--prism-by", "80 mm");
  refused({"--sphere", "-40", "--index", "1.3"}, "--sphere", "at least 15 mm");
  refused({"--thinning"}, "--thinning", "progressive");
  refused({"--design", "contact", "--base-curve", "5"}, "--base-curve", "contact lens");
  refused({"--panto", "61"}, "--panto", "from -60 to 60");
  refused({"--vertex", "-1"}, "--vertex", "from 0 to 100");
}

TEST_F(LensFromPrescription, RefusesBadOutlines) {
  refused({"--outline", "/nonexistent.json"}, "/nonexistent.json", "");
  const std::string flat = folder_.write("flat.json", R"({"polygon_mm": [[0, 0], [1, 1], [2, 2]]})");
  refused({"--outline", flat}, flat + ": polygon_mm", "encloses no area");
  const std::string far = folder_.write("far.json", R"({"polygon_mm": [[200, 0], [0, 200], [-200, 0]]})");
  refused({"--outline", far}, "--outline", "across");
}

TEST_F(LensFromPrescription, FailsWhereTheFileCannotBeWritten) {
  const std::string missing = (folder_.path() / "missing" / "lens.json").string();
  const ProgramResult result =
      run_program({.arguments = {"lens", "from-prescription", "--sphere", "1", "--output", missing}});
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(result.err.starts_with("vergence: " + missing)) << result.err;
}

TEST(LensCommand, NamesItsCommands) {
  const auto call = [](const Words& words) { return run_program({.arguments = words}); };
  EXPECT_TRUE(call({"lens"}).err.starts_with("vergence: COMMAND: is missing"));
  EXPECT_EQ(call({"lens"}).exit_status, 2);
  EXPECT_NE(call({"lens", "paint"}).err.find("paint: is not a command of vergence lens"), std::string::npos);
  EXPECT_NE(call({"lens", "--x"}).err.find("--x: is not an option of vergence lens"), std::string::npos);
  const ProgramResult help = call({"lens", "from-prescription", "--help"});
  EXPECT_EQ(help.exit_status, 0);
  EXPECT_NE(help.out.find("Example"), std::string::npos);
  EXPECT_NE(help.out.find("vergence lens from-prescription --sphere"), std::string::npos);
}

}  // namespace
