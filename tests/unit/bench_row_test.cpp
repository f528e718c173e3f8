// The benchmark's rows: statistics, the contract's JSON, the paper's table, the report's ratios.
#include "app/bench/bench_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/bench/bench_chart.hpp"
#include "app/bench/bench_growth.hpp"
#include "app/bench/bench_report.hpp"

namespace app {
namespace {

using nlohmann::json;

BenchRow row(const std::string& lens, const std::string& mode, int size, double trace, double rest) {
  BenchRow r{.lens = lens,
             .mode = mode,
             .shading = "bare",
             .size = size,
             .triangles = 12,
             .ms = {},
             .stages = {},
             .device = "a \"GPU\""};
  const std::vector<StageTimes> rounds{{{"trace", trace}, {"encode", rest}}};
  set_times(r, rounds);
  return r;
}

TEST(BenchRow, SpreadIsMedianLeastAndMost) {
  EXPECT_DOUBLE_EQ(spread_of({3.0, 1.0, 2.0}).median, 2.0);
  EXPECT_DOUBLE_EQ(spread_of({4.0, 1.0, 2.0, 3.0}).median, 2.5);
  const Spread one = spread_of({7.0});
  EXPECT_DOUBLE_EQ(one.median, 7.0);
  EXPECT_DOUBLE_EQ(one.min, 7.0);
  EXPECT_DOUBLE_EQ(one.max, 7.0);
  EXPECT_THROW(static_cast<void>(spread_of({})), std::invalid_argument);
}

// The frame's median is that of the rounds' sums: medians of stages need not add up to it.
TEST(BenchRow, FrameTimesAreSumsOfARound) {
  BenchRow r{.lens = "none",
             .mode = "pin",
             .shading = "bare",
             .size = 2,
             .triangles = 1,
             .ms = {},
             .stages = {},
             .device = "d"};
  const std::vector<StageTimes> rounds{
      {{"trace", 1.0}, {"encode", 9.0}}, {{"trace", 5.0}, {"encode", 1.0}}, {{"trace", 2.0}, {"encode", 2.0}}};
  set_times(r, rounds);
  EXPECT_DOUBLE_EQ(r.ms.median, 6.0);
  EXPECT_DOUBLE_EQ(r.ms.min, 4.0);
  EXPECT_DOUBLE_EQ(r.ms.max, 10.0);
  EXPECT_DOUBLE_EQ(r.stage("trace"), 2.0);
  EXPECT_DOUBLE_EQ(r.stage("encode"), 2.0);
  EXPECT_DOUBLE_EQ(r.stage("blur"), 0.0);
  EXPECT_DOUBLE_EQ(r.fps(), 1000.0 / 6.0);
}

// Table 1 of the paper.
TEST(BenchRow, PaperTableByName) {
  EXPECT_DOUBLE_EQ(paper_fps("none", "adof").value(), 66.5);
  EXPECT_DOUBLE_EQ(paper_fps("none", "dof").value(), 83.5);
  EXPECT_DOUBLE_EQ(paper_fps("sphere/torus", "vis").value(), 38.7);
  EXPECT_DOUBLE_EQ(paper_fps("bspline/sphere", "adof").value(), 31.7);
  EXPECT_DOUBLE_EQ(paper_fps("bspline/torus", "pin").value(), 31.6);
  EXPECT_FALSE(paper_fps("bspline/conic", "adof").has_value());
  for (const std::string& lens : kBenchLenses) {
    for (const std::string& mode : kBenchModes) {
      EXPECT_TRUE(paper_fps(lens, mode).has_value()) << lens << " " << mode;
    }
  }
}

TEST(BenchRow, JsonHasTheContractsFields) {
  const std::vector<BenchRow> rows{row("none", "pin", 64, 3.0, 1.0), row("bspline/sphere", "adof", 64, 4.0, 1.0)};
  const std::vector<PeerRow> peers{{"none", 64, 4096, {0.5, 0.4, 0.6}}};
  const json list = json::parse(rows_json(rows, peers));
  ASSERT_TRUE(list.is_array());
  ASSERT_EQ(list.size(), 2U);
  const json& first = list[0];
  EXPECT_EQ(first["lens"], "none");
  EXPECT_EQ(first["mode"], "pin");
  EXPECT_EQ(first["size"], 64);
  EXPECT_EQ(first["triangles"], 12);
  EXPECT_DOUBLE_EQ(first["ms_median"], 4.0);
  EXPECT_DOUBLE_EQ(first["ms_min"], 4.0);
  EXPECT_DOUBLE_EQ(first["ms_max"], 4.0);
  EXPECT_DOUBLE_EQ(first["fps"], 250.0);
  EXPECT_DOUBLE_EQ(first["stages_ms"]["trace"], 3.0);
  EXPECT_EQ(first["device"], "a \"GPU\"");
  EXPECT_DOUBLE_EQ(first["embree16_ms"], 0.5);
  EXPECT_FALSE(list[1].contains("embree16_ms")) << "a peer of another lens";
}

TEST(BenchRow, NoRowsAreAnEmptyList) {
  EXPECT_EQ(json::parse(rows_json({}, {})), json::array());
}

TEST(BenchRow, CsvHasAsManyFieldsAsItsHeader) {
  const std::vector<BenchRow> rows{row("none", "pin", 64, 3.0, 1.0)};
  const std::string csv = rows_csv(rows, {});
  const auto fields = [](const std::string& line) { return std::ranges::count(line, ','); };
  const std::size_t end = csv.find('\n');
  EXPECT_EQ(fields(csv.substr(0, end)), fields(csv.substr(end + 1)));
  EXPECT_NE(csv.find("\"a \"\"GPU\"\"\""), std::string::npos);
}

BenchReport report() {
  BenchReport r{.scene = "cars<1>.glb",
                .device = "d",
                .triangles = 12,
                .gflops = 100.0,
                .gigabytes_per_s = 10.0,
                .peer_threads = 2,
                .rounds = 3,
                .rows = {},
                .peers = {}};
  for (const int size : {1000, 2000}) {
    const double times = size / 1000.0 * (size / 1000.0);
    r.rows.push_back(row("none", "adof", size, 30.0 * times, 10.0 * times));
    r.rows.push_back(row("none", "pin", size, 25.0 * times, 5.0 * times));
    r.rows.push_back(row("bspline/sphere", "adof", size, 40.0 * times, 10.0 * times));
    r.peers.push_back({"none",
                       size,
                       static_cast<std::size_t>(size) * static_cast<std::size_t>(size),
                       {20.0 * times, 20.0 * times, 20.0 * times}});
    r.peers.push_back({"bspline/sphere", size, 900000, {25.0 * times, 25.0 * times, 25.0 * times}});
  }
  return r;
}

// 1e6 rays in 25 ms of tracing against 1e6 in 20 ms; 50 ms against 40 ms; 50 ms against 25 ms.
TEST(BenchReport, RatiosAreThoseOfTheRows) {
  const std::string table = bench_table(report());
  EXPECT_NE(table.find("40.0 M/s"), std::string::npos) << table;
  EXPECT_NE(table.find("Embree16 50.0 M/s: 0.80"), std::string::npos) << table;
  EXPECT_NE(table.find("bspline/sphere adof / none adof: 1.25 (paper: 2.10)"), std::string::npos) << table;
  EXPECT_NE(table.find("25.00 to 25.00): 2.00"), std::string::npos) << table;
  // Where hits are found in a stage of their own, it alone counts.
  BenchReport tiled = report();
  tiled.rows[1].stages = {{"rays", 5.0}, {"tile", 10.0}, {"trace", 10.0}, {"encode", 5.0}};
  const std::string of_tiles = bench_table(tiled);
  EXPECT_NE(of_tiles.find("100.0 M/s (tile stage of none/pin), Embree16 50.0 M/s: 2.00"), std::string::npos)
      << of_tiles;
}

// The paper's 1000 / 66.5 ms at 1024 squared is that times (1000 / 1024)^2 at 1000 squared.
TEST(BenchReport, PaperIsScaledByPixels) {
  EXPECT_NE(bench_table(report()).find("14.34"), std::string::npos) << bench_table(report());
}

TEST(BenchReport, LinearGrowthHasRatioOne) {
  const std::string table = bench_table(report());
  const std::string growth = table.substr(table.find("Nanoseconds a pixel"));
  EXPECT_NE(growth.find("40.0      40.0     1.00"), std::string::npos) << growth;
}

// Points on 2 ms + 30 ms a megapixel; and on a square root, which no line meets.
TEST(BenchGrowth, FitFindsTheLineAndTheExponent) {
  const std::vector<GrowthPoint> line{{0.25e6, 9.5}, {1e6, 32.0}, {4e6, 122.0}};
  const GrowthFit fit = fit_growth(line);
  EXPECT_NEAR(fit.fixed_ms, 2.0, 1e-9);
  EXPECT_NEAR(fit.ms_a_megapixel, 30.0, 1e-9);
  EXPECT_NEAR(fit.largest_departure, 0.0, 1e-12);
  EXPECT_NEAR(fit.exponent, std::log(122.0 / 9.5) / std::log(16.0), 1e-9) << "equal steps: the end points' slope";
  const GrowthFit bent = fit_growth(std::vector<GrowthPoint>{{1e6, 10.0}, {4e6, 20.0}, {16e6, 40.0}});
  EXPECT_NEAR(bent.exponent, 0.5, 1e-9);
  EXPECT_GT(bent.largest_departure, 0.05);
  EXPECT_THROW(static_cast<void>(fit_growth(std::vector<GrowthPoint>{{1.0, 1.0}})), std::invalid_argument);
}

TEST(BenchGrowth, ThreeSizesShowTheirLine) {
  BenchReport r = report();
  r.rows.push_back(row("none", "adof", 500, 9.0, 3.0));  // 2.67 ms fixed, 37.33 a megapixel: 12, 40, (149.3) 152
  r.rows[3].ms = {152.0, 152.0, 152.0};
  const std::string table = growth_table(r);
  EXPECT_NE(table.find("none             adof bare "), std::string::npos) << table;
  EXPECT_NE(table.find("2.67 + 37.33 a megapixel, within 0.0 %"), std::string::npos) << table;
  r.rows.resize(1);
  EXPECT_TRUE(growth_table(r).empty());
}

TEST(BenchReport, FilesAndFinerNetsStandBesideTheTable) {
  BenchReport r = report();
  const std::string file = "a folder/<mine> & a rather long name of a pair, worn.json";
  r.rows.push_back(row(kFineNetLens, "adof", 2000, 166.0, 40.0));
  r.rows.push_back(row(file, "adof", 2000, 166.0, 40.0));
  const std::string table = bench_table(r);
  EXPECT_NE(table.find("100 x 100 control points / 50 x 50: frame 1.030 (least over least 1.030), trace stage 1.038"),
            std::string::npos)
      << table;
  const std::string line = table.substr(table.find(file), 120);
  EXPECT_NE(line.find("206.00"), std::string::npos) << line;
  EXPECT_NE(line.find(" - "), std::string::npos) << "no time of the paper's: " << line;
  const std::string csv = rows_csv(r.rows, {});
  EXPECT_NE(csv.find("\"" + file + "\",adof"), std::string::npos) << csv;
  const std::string chart = to_svg(bench_chart(r));
  EXPECT_EQ(chart.find("<mine>"), std::string::npos);
  EXPECT_NE(chart.find("pair, worn adof"), std::string::npos) << chart;
  for (const Chart::Label& label : bench_chart(r).labels) {
    EXPECT_LE(label.x + render::text_width(label.text, 1), bench_chart(r).width) << label.text;
  }
}

TEST(BenchReport, PageEscapesAndChartHasABarARow) {
  EXPECT_NE(bench_page(report()).find("cars&lt;1&gt;.glb"), std::string::npos);
  const std::string chart = to_svg(bench_chart(report()));
  std::size_t bars = 0;
  for (std::size_t at = chart.find("height=\"12\""); at != std::string::npos;
       at = chart.find("height=\"12\"", at + 1)) {
    ++bars;
  }
  EXPECT_EQ(bars, 3U) << "the three rows of the larger size";
}

TEST(BenchReport, ChartFitsItsPicture) {
  const Chart chart = bench_chart(report());
  for (const Chart::Bar& bar : chart.bars) {
    EXPECT_GE(bar.place.width, 0);
    EXPECT_LE(bar.place.x + bar.place.width, chart.width);
    EXPECT_LE(bar.place.y + bar.place.height, chart.height);
  }
  for (const Chart::Label& label : chart.labels) {
    EXPECT_LE(label.x + render::text_width(label.text, 1), chart.width) << label.text;
  }
  EXPECT_EQ(to_image(chart).width, chart.width);
}

}  // namespace
}  // namespace app
