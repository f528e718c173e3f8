// vergence lens from-sdf, to-sdf, from-oma, to-oma, check: what they write and say, and how they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "lenses/lens_io/lens_io.hpp"
#include "tests/support/run_program.hpp"

namespace {

using nlohmann::json;
using support::ProgramResult;
using support::run_program;
using support::TemporaryFolder;
using Words = std::vector<std::string>;

const std::string kSurface = VERGENCE_ASSETS "/lenses/progressive_add200_right.sdf";
const std::string kJob = VERGENCE_ASSETS "/jobs/progressive_pair.oma";
const std::string kPair = VERGENCE_ASSETS "/spectacles/presbyopia_bspline_torus.json";

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

ProgramResult lens(Words words) {
  words.insert(words.begin(), "lens");
  return run_program({.arguments = words});
}

json done(const Words& words) {
  const ProgramResult result = lens(words);
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return json::parse(result.out, nullptr, false);
}

class LensFiles : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  // One line that names the place, exit status 2, nothing written.
  void expect_refused(const Words& words, const std::string& what, const std::string& word) {
    SCOPED_TRACE(testing::PrintToString(words));
    const Words before = folder_.names();
    const ProgramResult result = lens(words);
    EXPECT_EQ(result.exit_status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with("vergence: " + what + ": ")) << result.err;
    EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_EQ(folder_.names(), before);
  }

  TemporaryFolder folder_;
};

TEST_F(LensFiles, SurfacesGoThereAndBack) {
  const json made = done({"from-sdf", kSurface, "--other-radius", "119.25", "--output", path("a.json"), "--json"});
  EXPECT_EQ(made["surface"], "front");
  EXPECT_NEAR(made["diameter_mm"].get<double>(), 70.0, 1e-3);
  EXPECT_EQ(made["fit"]["samples"], 71 * 71);
  EXPECT_LT(made["fit"]["residual_max_um"].get<double>(), 0.002);
  EXPECT_LT(made["fit"]["power_noise_D"].get<double>(), 0.002);
  for (const std::string format : {"sdf", "hmf", "xyz"}) {
    for (const std::string rows : {"top", "bottom"}) {
      const std::string table = path("b." + format);
      done({"to-sdf", path("a.json"), "--rows", rows, "--output", table, "--json"});
      done({"from-sdf", table, "--lens", path("a.json"), "--rows", rows, "--output", path("c.json"), "--json"});
      const lenses::Lens a = lenses::read_lens(path("a.json")), c = lenses::read_lens(path("c.json"));
      EXPECT_EQ(a.back, c.back);
      const auto &first = std::get<lenses::BsplineHeightField>(a.front),
                 &second = std::get<lenses::BsplineHeightField>(c.front);
      ASSERT_EQ(first.control_z.size(), second.control_z.size());
      // Heights are written to 1 nm; at the border a control moves by more than the surface.
      double most = 0.0;
      for (std::size_t i = 0; i < first.control_z.size(); ++i) {
        most = std::max(most, std::abs(first.control_z[i] - second.control_z[i]));
      }
      EXPECT_LT(most, 2e-7);
    }
  }
  // Coarser digits: the report says what that costs.
  const json coarse = done({"to-sdf", path("a.json"), "--decimals", "3", "--output", path("d.sdf"), "--json"});
  EXPECT_GT(coarse["read_back"]["power_noise_D"].get<double>(), 0.003);
  EXPECT_NEAR(coarse["read_back"]["noise_um"].get<double>(), 0.2887, 1e-3);
}

TEST_F(LensFiles, ASurfaceWithoutAPartnerGetsOneOfNoPower) {
  done({"from-sdf", kSurface, "--surface", "back", "--index", "1.5", "--diameter", "50", "--output", path("a.json"),
        "--json"});
  const lenses::Lens made = lenses::read_lens(path("a.json"));
  EXPECT_TRUE(std::holds_alternative<lenses::BsplineHeightField>(made.back));
  EXPECT_TRUE(std::holds_alternative<lenses::Sphere>(made.front));
  EXPECT_NEAR(made.diameter, 0.050, 1e-12);
}

TEST_F(LensFiles, JobsGoThereAndBackByteForByte) {
  const json made = done({"from-oma", kJob, "--output", path("a.json"), "--json"});
  EXPECT_EQ(made["right"]["index"], 1.6);
  EXPECT_EQ(made["left"]["back"]["from"], "prescription");
  done({"to-oma", path("a.json"), "--job", kJob, "--output", path("b.oma"), "--json"});
  EXPECT_EQ(text_of(path("b.oma")), text_of(kJob));
  done({"to-oma", kPair, "--output", path("c.oma"), "--json"});
  const json tables = done({"from-oma", path("c.oma"), "--output", path("d.json"), "--json"});
  EXPECT_EQ(tables["right"]["front"]["from"], "SURFMT");
  EXPECT_LT(tables["right"]["front"]["fit"]["residual_max_um"].get<double>(), 0.01);
}

TEST_F(LensFiles, CheckSaysWhatIsWrong) {
  const json fine = done({"check", kPair, kJob, "--json"});
  ASSERT_EQ(fine.size(), 4U);
  for (const json& one : fine) EXPECT_TRUE(one["fine"].get<bool>()) << one;
  json bad = json::parse(text_of(VERGENCE_ASSETS "/spectacles/hyperopia.json"));
  bad["left"]["centre_thickness_mm"] = 1.0;
  const std::string file = folder_.write("bad.json", bad.dump());
  for (const bool as_json : {false, true}) {
    Words words{"check", file, path("none.json"), kPair};
    if (as_json) words.emplace_back("--json");
    const ProgramResult result = lens(words);
    EXPECT_EQ(result.exit_status, 2);
    EXPECT_EQ(result.err, "vergence: FILE: 2 of 5 lenses have faults; each is named on standard output\n");
    if (as_json) {
      const json list = json::parse(result.out);
      EXPECT_TRUE(list[0]["fine"].get<bool>());
      EXPECT_EQ(list[1]["findings"][0]["fault"], "surfaces_cross");
      EXPECT_TRUE(list[2].contains("error"));
      EXPECT_TRUE(list[4]["fine"].get<bool>());
    } else {
      EXPECT_NE(result.out.find(file + ": right: fine"), std::string::npos) << result.out;
      EXPECT_NE(result.out.find(file + ": left: diameter_mm: lets front and back surface cross"), std::string::npos);
      EXPECT_NE(result.out.find(path("none.json") + ": cannot be read"), std::string::npos);
    }
  }
  const ProgramResult strict = lens({"check", kPair, "--min-edge", "19"});
  EXPECT_EQ(strict.exit_status, 2);
  EXPECT_NE(strict.out.find("leaves an edge of"), std::string::npos);
}

TEST_F(LensFiles, RefuseBadInput) {
  const std::string out = path("out.json");
  const std::string broken = folder_.write("broken.sdf", "SURFMT=1;R;F;4;4;3;3;0\nZZ=0;0;0\n");
  expect_refused({"from-sdf", broken, "--output", out}, broken + ": line 2: ZZ", "4 columns");
  expect_refused({"from-sdf", path("none.sdf"), "--output", out}, path("none.sdf"), "cannot be read");
  expect_refused({"from-sdf", folder_.write("table.bin", "1"), "--output", out}, path("table.bin"), ".sdf .hmf .xyz");
  expect_refused({"from-sdf", kSurface, "--index", "0.5", "--output", out}, "--index", "from 1 to 4");
  expect_refused({"from-sdf", kSurface, "--diameter", "71", "--output", out}, "--diameter", "70 mm");
  expect_refused({"from-sdf", kSurface, "--other-radius", "round", "--output", out}, "--other-radius", "flat");
  expect_refused({"from-sdf", kSurface, "--smoothing", "-1", "--output", out}, "--smoothing", "from 0");
  expect_refused({"from-sdf", kSurface, "--lens", kPair, "--output", out}, kPair + ": left", "unknown key");
  expect_refused({"from-sdf"}, "FILE", "is missing");
  expect_refused({"from-sdf", kSurface, "--rows", "middle"}, "--rows", "top");
  expect_refused({"to-sdf", kPair, "--output", path("out.txt")}, "--output", ".sdf, .hmf, .xyz");
  expect_refused({"to-sdf", kPair, "--count", "3", "--output", path("out.sdf")}, "--count", "from 4");
  expect_refused({"to-sdf", kPair, "--size", "0", "--output", path("out.sdf")}, "--size", "from 1");
  const std::string job = folder_.write("job.oma", "SPH=-2\nCYL=1\n");
  expect_refused({"from-oma", job, "--output", out}, job + ": line 2: CYL", "axis");
  expect_refused({"from-oma", kPair, "--output", out}, kPair + ": line 1", "LABEL=value");
  expect_refused({"to-oma", VERGENCE_ASSETS "/lenses/progressive_add200_right.json", "--output", path("out.oma")},
                 VERGENCE_ASSETS "/lenses/progressive_add200_right.json: right", "missing");
  expect_refused({"to-oma", kPair, "--job", job, "--output", path("out.oma")}, job + ": line 2: CYL", "axis");
  expect_refused({"check"}, "FILE", "is missing");
  expect_refused({"check", kPair, "--min-edge", "-1"}, "--min-edge", "from 0");
}

}  // namespace
