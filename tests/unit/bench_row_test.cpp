// The benchmark's rows: statistics, the contract's JSON, the paper's table, the report's ratios.
#include "app/bench/bench_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/bench/bench_chart.hpp"
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
