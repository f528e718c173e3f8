// SDF, HMF and XYZ: sides, row orders, round trips, the precision that digits tell, and what is refused.
#include "lenses/lens_io/sag_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>
#include <stdexcept>

#include "lenses/design/progressive_family.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "tests/support/surface_probe.hpp"
#include "tracking/input_error.hpp"

namespace {

using lenses::Face;
using lenses::RowOrder;
using lenses::SagFile;
using lenses::SagFormat;
using lenses::SagGrid;
using lenses::SagReading;
using lenses::SagWriting;
using lenses::Side;
using support::SurfaceProbe;

const std::string kSample = VERGENCE_ASSETS "/lenses/progressive_add200_right.sdf";

// Heights that tell every place from every other.
SagGrid skew_grid(std::size_t columns = 5, std::size_t rows = 5, double width = 0.008, double height = 0.008) {
  SagGrid grid{columns, rows, width, height, {}};
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < rows; ++j)
      grid.sag.push_back(1e-3 * static_cast<double>(i) + 1e-5 * static_cast<double>(j));
  }
  return grid;
}

double height_at(const SagFile& file, double x, double y) {
  for (const glm::dvec3& point : file.samples.points) {
    if (std::hypot(point.x - x, point.y - y) < 1e-9) return point.z;
  }
  return std::nan("");
}

void expect_grid(const SagFile& file, const SagGrid& grid) {
  ASSERT_EQ(file.samples.points.size(), grid.sag.size());
  for (std::size_t i = 0; i < grid.columns; ++i) {
    for (std::size_t j = 0; j < grid.rows; ++j) {
      EXPECT_NEAR(height_at(file, grid.x(i), grid.y(j)), grid.sag[i * grid.rows + j], 1e-15) << i << ' ' << j;
    }
  }
}

TEST(SagFile, ComesBackInEveryFormatAndOrder) {
  for (const SagFormat format : {SagFormat::sdf, SagFormat::hmf, SagFormat::xyz}) {
    for (const RowOrder rows : {RowOrder::top_first, RowOrder::bottom_first}) {
      const SagGrid grid = skew_grid();
      const std::string text = to_sag(format, grid, {.rows = rows});
      expect_grid(parse_sag(format, text, "t", {.rows = rows}), grid);
    }
  }
  const SagGrid wide = skew_grid(7, 5, 0.012, 0.006);
  expect_grid(lenses::parse_sdf(to_sdf(wide, {}), "t"), wide);
  expect_grid(lenses::parse_xyz(to_xyz(wide, {}), "t"), wide);
  EXPECT_THROW((void)to_hmf(wide, {}), std::invalid_argument);
}

// The first number of a file is that of the viewer's upper left: our +x, +y.
TEST(SagFile, BeginsAtTheViewersUpperLeft) {
  const std::string rows = "ZZ=1;2;3;4\nZZ=5;6;7;8\nZZ=9;10;11;12\nZZ=13;14;15;16\n";
  for (const std::string header : {"SURFMT=1;R;F;4;4;6;9;0\n", "SURFMT=1;L;B;4;4;6;9;0\n"}) {
    const SagFile top = lenses::parse_sdf(header + rows, "t");
    EXPECT_NEAR(height_at(top, 0.003, 0.0045), 0.001, 1e-15);
    EXPECT_NEAR(height_at(top, -0.003, 0.0045), 0.004, 1e-15);
    EXPECT_NEAR(height_at(top, 0.003, -0.0045), 0.013, 1e-15);
    const SagFile bottom = lenses::parse_sdf(header + rows, "t", {.rows = RowOrder::bottom_first});
    EXPECT_NEAR(height_at(bottom, 0.003, -0.0045), 0.001, 1e-15);
    EXPECT_NEAR(height_at(bottom, -0.003, 0.0045), 0.016, 1e-15);
  }
  const SagFile xyz = lenses::parse_xyz("-3 4.5 1\n", "t");
  EXPECT_NEAR(height_at(xyz, 0.003, 0.0045), 0.001, 1e-15);
}

TEST(SagFile, KnowsItsSideAndFace) {
  for (const Side side : {Side::right, Side::left}) {
    for (const Face face : {Face::front, Face::back}) {
      const SagFile file = lenses::parse_sdf(to_sdf(skew_grid(), {.side = side, .face = face}), "t");
      EXPECT_EQ(file.side, side);
      EXPECT_EQ(file.face, face);
    }
  }
  EXPECT_EQ(lenses::parse_hmf(to_hmf(skew_grid(), {}), "t").side, std::nullopt);
}

TEST(SagFile, ChoosesAmongSeveralSurfaces) {
  std::string text;
  double offset = 0.0;
  for (const Side side : {Side::right, Side::left}) {
    for (const Face face : {Face::front, Face::back}) {
      SagGrid grid = skew_grid();
      offset += 0.1;
      for (double& z : grid.sag) z += offset;
      text += to_sdf(grid, {.side = side, .face = face});
    }
  }
  const SagFile left_front = lenses::parse_sdf(text, "t", {.side = Side::left, .face = Face::front});
  EXPECT_NEAR(height_at(left_front, -0.004, -0.004), 0.3, 1e-15);
  EXPECT_THROW((void)lenses::parse_sdf(text, "t", {.side = Side::left}), tracking::InputError);
}

TEST(SagFile, LeavesOutWhatIsNotKnown) {
  const SagFile file =
      lenses::parse_sdf("SURFMT=1;R;F;4;4;3;3;0\nZZ=?;0;0;?\nZZ=0;0;0;0\nZZ=0;0;0;0\nZZ=?;0;0;?\n", "t");
  EXPECT_EQ(file.samples.points.size(), 12U);
}

double noise_of(const std::string& numbers) {
  return lenses::parse_xyz(numbers, "t").samples.noise;
}

// Rounding errors are uniform: a step / sqrt(12). Trailing zeros may be missing; significant digits are a step by size.
TEST(SagFile, LearnsTheRoundingFromTheDigits) {
  const double unit = 1e-3 / std::sqrt(12.0);  // of a mm
  EXPECT_NEAR(noise_of("0 0 1.2345\n1 0 0.0001\n"), 1e-4 * unit, 1e-12 * unit);
  EXPECT_NEAR(noise_of("0 0 1.2\n1 0 1.2345\n2 0 3\n3 0 0\n"), 1e-4 * unit, 1e-12 * unit);
  EXPECT_NEAR(noise_of("0 0 1.2345e+01\n"), 1e-3 * unit, 1e-12 * unit);
  EXPECT_NEAR(noise_of("0 0 12\n"), 1.0 * unit, 1e-12 * unit);
  // Five significant digits: 1e-3 for 12.345, 1e-5 for 0.12345.
  EXPECT_NEAR(noise_of("0 0 12.345\n1 0 0.12345\n"), std::sqrt((1e-6 + 1e-10) / 2.0) * unit, 1e-9 * unit);
}

// The sample is the closed form sampled to a nanometre; the contract's lens of it was fitted to the closed form.
TEST(SagFile, ReadsTheSampleAsTheSurfaceItIs) {
  const SagFile file = lenses::read_sag_file(kSample);
  EXPECT_EQ(file.side, Side::right);
  EXPECT_EQ(file.face, Face::front);
  EXPECT_EQ(file.samples.points.size(), 71U * 71U);
  EXPECT_NEAR(file.samples.noise, 1e-9 / std::sqrt(12.0), 1e-15);
  const lenses::ProgressiveFamily surface;
  const auto closed_form = [&](double x, double y) { return surface.height(-x, y); };
  for (const glm::dvec3& point : file.samples.points) {
    ASSERT_NEAR(point.z, closed_form(point.x, point.y), 0.51e-9);
  }
  const lenses::SplineFit fit = fit_sag_file(file, kSample);
  const SurfaceProbe fitted(fit.surface);
  const SurfaceProbe stored(lenses::read_lens(VERGENCE_TEST_DATA "/progressive_add200_right.json").front);
  const auto of = [](const SurfaceProbe& probe) { return [&](double x, double y) { return probe.at(x, y).hessian; }; };
  const auto truth = [&](double x, double y) { return support::hessian_of(closed_form, x, y); };
  // Measured: rms 0.0019 D of power and 0.0031 D of cylinder, at most 0.020 and 0.033 D; the stored lens is a net of
  // 50 x 50 controls with at most 0.04 and 0.065 D.
  const auto to_truth = support::power_difference(of(fitted), truth, 1.6, 0.028);
  EXPECT_LT(to_truth.power_rms, 0.003);
  EXPECT_LT(to_truth.power_max, 0.03);
  EXPECT_LT(to_truth.cylinder_rms, 0.005);
  EXPECT_LT(to_truth.cylinder_max, 0.05);
  const auto to_stored = support::power_difference(of(fitted), of(stored), 1.6, 0.028);
  EXPECT_LT(to_stored.power_rms, 0.006);
  EXPECT_LT(to_stored.power_max, 0.05);
  EXPECT_LT(to_stored.cylinder_max, 0.08);
  EXPECT_LT(fit.residual_max, 2e-9);
  EXPECT_LT(fit.power_noise(1.6), 0.002);
}

// The examples of the other two formats: a sphere of 100 mm, to 1 nm on a grid of 3 mm.
TEST(SagFile, ReadsTheExamples) {
  for (const std::string name : {"sphere_100mm.hmf", "sphere_100mm.xyz"}) {
    const SagFile file = lenses::read_sag_file(VERGENCE_ASSETS "/lenses/" + name);
    EXPECT_EQ(file.samples.points.size(), 21U * 21U);
    const SurfaceProbe probe(fit_sag_file(file, name).surface);
    for (const glm::dvec2 at : {glm::dvec2(0.0), glm::dvec2(0.011, -0.017)}) {
      const double truth = 0.1 - std::sqrt(0.01 - at.x * at.x - at.y * at.y);
      EXPECT_NEAR(probe.at(at.x, at.y).z, truth, 2e-9);
      EXPECT_NEAR(probe.at(at.x, at.y).hessian.x,
                  10.0 * (1.0 - 100.0 * at.y * at.y) / std::pow(1.0 - 100.0 * dot(at, at), 1.5), 0.01);
    }
  }
}

TEST(SagFile, GivesALensItsSurface) {
  const std::string folder = VERGENCE_ASSETS "/lenses/";
  const auto lens_text = [](const std::string& front) {
    return R"({"index": 1.6, "centre_thickness_mm": 2, "diameter_mm": 64, "front": {"type": "file", )" + front +
           R"(}, "back": {"type": "sphere", "radius_mm": 119.25}})";
  };
  const lenses::Lens lens =
      lenses::parse_lens(lens_text(R"("path": "progressive_add200_right.sdf")"), folder + "x.json");
  const auto fit = fit_sag_file(lenses::read_sag_file(kSample), kSample);
  EXPECT_EQ(std::get<lenses::BsplineHeightField>(lens.front), fit.surface);
  EXPECT_EQ(lenses::read_lens(folder + "progressive_sdf_right.json").front, lens.front);
  const auto smooth = lenses::parse_lens(
      lens_text(R"("path": "progressive_add200_right.sdf", "rows": "bottom", "smoothing_um": 1, "height_mm": 0.5)"),
      folder + "x.json");
  EXPECT_EQ(smooth.front_placement.height, 0.5e-3);
  const SurfaceProbe upright(lens.front), turned(smooth.front);
  EXPECT_NEAR(upright.at(0.01, 0.01).z, turned.at(0.01, -0.01).z, 5e-6);
  EXPECT_GT(std::abs(upright.at(0.0, 0.03).z - turned.at(0.0, 0.03).z), 1e-4);
  for (const std::string path : {"../lenses/progressive_add200_right.sdf", "/etc/passwd", "", "none.sdf", ".", "..",
                                 "progressive_add200_right.json"}) {
    try {
      (void)lenses::parse_lens(lens_text("\"path\": \"" + path + "\""), folder + "x.json");
      ADD_FAILURE() << path;
    } catch (const tracking::InputError& error) {
      EXPECT_EQ(error.field(), "front.path") << path;
    }
  }
}

struct Bad {
  std::string text, field, word;
};

void expect_refused(SagFormat format, const std::vector<Bad>& cases) {
  for (const Bad& bad : cases) {
    SCOPED_TRACE(bad.text);
    try {
      (void)parse_sag(format, bad.text, "t");
      ADD_FAILURE() << "was read";
    } catch (const tracking::InputError& error) {
      EXPECT_EQ(error.field(), bad.field) << error.what();
      EXPECT_NE(error.reason().find(bad.word), std::string::npos) << error.what();
    }
  }
}

TEST(SagFile, RefusesDamagedSdf) {
  const std::string good = "SURFMT=1;R;F;4;4;3;3;0\n", row = "ZZ=0;0;0;0\n";
  expect_refused(SagFormat::sdf, {{"", "SURFMT", "missing"},
                                  {"hello", "line 1", "LABEL=value"},
                                  {row, "line 1: ZZ", "before any SURFMT"},
                                  {good + row, "line 1: SURFMT", "announces 4 rows; 1"},
                                  {good + row + row + row + row + row, "line 6: ZZ", "row too many"},
                                  {good + "ZZ=0;0;0\n", "line 2: ZZ", "has 3 numbers"},
                                  {good + "ZZ=0;0;x;0\n", "line 2: ZZ", "entry 3"},
                                  {good + "ZZ=0;0;nan;0\n", "line 2: ZZ", "entry 3"},
                                  {good + "ZZ=0;0;0,5;0\n", "line 2: ZZ", "entry 3"},
                                  {good + "ZZ=0;1e9;0;0\n", "line 2: ZZ", "entry 2"},
                                  {"SURFMT=2;R;F;4;4;3;3;0\n", "line 1: SURFMT", "format"},
                                  {"SURFMT=1;X;F;4;4;3;3;0\n", "line 1: SURFMT", "side"},
                                  {"SURFMT=1;R;Q;4;4;3;3;0\n", "line 1: SURFMT", "side"},
                                  {"SURFMT=1;R;F;4;4;3\n", "line 1: SURFMT", "fields"},
                                  {"SURFMT=1;R;F;4;4;3;3;90\n", "line 1: SURFMT", "only 0"},
                                  {"SURFMT=1;R;F;3;4;3;3;0\n", "line 1: SURFMT", "columns"},
                                  {"SURFMT=1;R;F;4;4.5;3;3;0\n", "line 1: SURFMT", "rows"},
                                  {"SURFMT=1;R;F;2000000000;4;3;3;0\n", "line 1: SURFMT", "columns"},
                                  {"SURFMT=1;R;F;2001;2001;3;3;0\n", "line 1: SURFMT", "heights"},
                                  {"SURFMT=1;R;F;4;4;0;3;0\n", "line 1: SURFMT", "width"},
                                  {"SURFMT=1;R;F;4;4;3;-3;0\n", "line 1: SURFMT", "height"},
                                  {"SURFMT=1;R;F;4;4;3;1e300;0\n", "line 1: SURFMT", "height"}});
}

TEST(SagFile, RefusesDamagedHmf) {
  const std::string head = "File Version=1.2\n[Properties]\n", size = "Count=4\nInterval=1\n";
  expect_refused(SagFormat::hmf, {{"", "[Data]", "missing"},
                                  {"File Version=3.0\n", "line 1: File Version", "version 1"},
                                  {head + "[Data]\n", "Count", "missing"},
                                  {head + "Count=4\n[Data]\n", "Interval", "missing"},
                                  {head + "Count=1e9\n", "line 3: Count", "whole number"},
                                  {head + "Count=4\nCount=4\n", "line 4: Count", "twice"},
                                  {head + "Interval=0\n", "line 3: Interval", "above 0"},
                                  {head + "Count=1000\nInterval=1\n[Data]\n", "line 5", "opens a table"},
                                  {head + "nonsense\n", "line 3", "NAME=value"},
                                  {head + "[Other]\n", "line 3", "[Data]"},
                                  {head + size + "[Data]\n1,2,3\n", "line 6", "has 3 numbers"},
                                  {head + size + "[Data]\n1,2,3,4\n", "[Data]", "holds 1 rows"},
                                  {head + size + "[Data]\n1,2,,4\n", "line 6", "entry 3"}});
}

TEST(SagFile, RefusesDamagedXyz) {
  expect_refused(SagFormat::xyz, {{"1 2\n", "line 1", "2 numbers"},
                                  {"# x y z\n1 2 3 4\n", "line 2", "4 numbers"},
                                  {"1 2 z\n", "line 1", "entry 3"},
                                  {"x y z\n", "line 1", "x is"},
                                  {"1e9 0 0\n", "line 1", "x is"},
                                  {"0 inf 0\n", "line 1", "y is"}});
  try {
    (void)fit_sag_file(lenses::parse_xyz("0 0 0\n1 1 1\n", "t"), "t");
    ADD_FAILURE();
  } catch (const tracking::InputError& error) {
    EXPECT_NE(error.reason().find("at least 4"), std::string::npos);
  }
  EXPECT_THROW((void)lenses::read_sag_file("surface.bin"), tracking::InputError);
}

}  // namespace
