// What is made of a trade-off's measurements: the efficient line, the advice and the files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/report/log_plot.hpp"
#include "app/tradeoff/tradeoff_advice.hpp"
#include "app/tradeoff/tradeoff_chart.hpp"
#include "app/tradeoff/tradeoff_page.hpp"

namespace {

using app::TradeoffReport;
using app::TradeoffRow;

TradeoffRow row(const std::string& setting, double ms, std::optional<double> rmse, const std::string& mode = "adof",
                int samples = 1) {
  TradeoffRow r;
  r.setting = setting;
  r.subject = mode == "dof" ? "dof samples" : setting == "standard" || mode != "adof" ? "mode" : "lens form";
  r.what = "a setting";
  r.mode = mode;
  r.samples = samples;
  r.ms = {ms, 0.9 * ms, 1.2 * ms};
  r.rounds = 3;
  r.stages = {{"trace", 0.7 * ms}, {"blur", 0.3 * ms}};
  r.rmse = rmse;
  if (rmse) {
    r.psnr_db = -20.0 * std::log10(*rmse);
    r.flip = *rmse;
  }
  r.power_error_D_p99 = 1e-5 * ms;
  r.astigmatism_error_D_p99 = 1e-12;
  return r;
}

TradeoffReport report() {
  TradeoffReport r;
  r.scene = "room <1>.glb";
  r.device = "device";
  r.spectacles = "none";
  r.width = r.height = 64;
  r.reference_samples = 1024;
  r.accuracy = "standard";
  r.rows = {row("standard", 100.0, 0.01),
            row("pinhole", 80.0, 0.1, "pinhole"),
            row("vis", 50.0, std::nullopt, "power"),
            row("coarse", 60.0, 0.05),
            row("slow", 150.0, 0.02),
            row("dof-1", 70.0, 0.08, "dof", 1),
            row("dof-4", 280.0, 0.04, "dof", 4),
            row("dof-16", 1120.0, 0.02, "dof", 16),
            row("dof-64", 4480.0, 0.005, "dof", 64)};
  mark_efficient(r.rows);
  r.target_rmse = 0.01;
  return r;
}

TEST(TradeoffRows, TheLineIsWhatNothingBeats) {
  const TradeoffReport r = report();
  std::vector<std::string> line;
  for (const TradeoffRow* row : efficient_rows(r.rows)) {
    line.push_back(row->setting);
  }
  EXPECT_EQ(line, (std::vector<std::string>{"coarse", "standard", "dof-64"}));
}

TEST(TradeoffRows, OfEqualsTheFirstIsEfficient) {
  std::vector<TradeoffRow> rows{row("a", 10.0, 0.1), row("b", 10.0, 0.1), row("c", 10.0, 0.2)};
  mark_efficient(rows);
  EXPECT_TRUE(rows[0].efficient);
  EXPECT_FALSE(rows[1].efficient);
  EXPECT_FALSE(rows[2].efficient);
}

// Between 16 samples (0.02) and 64 (0.005) on a straight line of logarithms: 0.01 at 32, half of the way in decades and
// a third of it in samples.
TEST(TradeoffRows, DofNeedsSamplesBetweenTheMeasuredOnes) {
  const TradeoffReport r = report();
  const auto need = dof_need(r.rows, 0.01);
  ASSERT_TRUE(need);
  EXPECT_NEAR(need->samples, 32.0, 1e-9);
  EXPECT_NEAR(need->ms, 1120.0 + 16.0 / 48.0 * 3360.0, 1e-9);
  EXPECT_FALSE(need->at_most || need->more_than);
  EXPECT_TRUE(dof_need(r.rows, 0.5)->at_most);
  EXPECT_TRUE(dof_need(r.rows, 0.001)->more_than);
  EXPECT_FALSE(dof_need(std::span(r.rows).first(3), 0.01));
}

TEST(TradeoffAdvice, SaysWhatTheNextStepGivesAndCosts) {
  TradeoffReport r = report();
  const auto sentences = advice(r);
  ASSERT_GE(sentences.size(), 4U);
  EXPECT_EQ(sentences[0],
            "standard gives 40.0 dB for 100 ms; the next step up, dof-64, costs 4380 ms more (44.8 times the time) and "
            "gains 6.0 dB.");
  EXPECT_EQ(sentences[1], "A step down, coarse, takes 60 ms (60 % of it) and loses 14.0 dB.");
  EXPECT_EQ(sentences[3],
            "For an error of 0.01 (40.0 dB) distributed rays need about 32 samples, 2240 ms: 22.4 times as long as "
            "standard with that error.");
  r.accuracy = "dof-64";
  EXPECT_NE(advice(r)[0].find("no setting measured here is better"), std::string::npos);
  r.accuracy = "vis";
  EXPECT_FALSE(advice(r).empty()) << "a map has no error of its own to speak of";
}

TEST(TradeoffFiles, TheTableHasTheColumnsThatScriptsRelyOn) {
  const std::string csv = tradeoff_csv(report().rows);
  EXPECT_TRUE(csv.starts_with(
      "setting,samples,time_ms,time_ms_min,time_ms_max,rmse,psnr_db,power_error_D_p99,astigmatism_error_D_p99,"));
  EXPECT_NE(csv.find("standard,1,100.000000,90.000000,120.000000,0.01,40,0.001,1e-12,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("vis,1,50.000000,45.000000,60.000000,,,0.0005,1e-12,,no,power,"), std::string::npos) << csv;
  EXPECT_EQ(std::ranges::count(csv, '\n'), 10);
}

TEST(TradeoffFiles, JsonHasNoInfinity) {
  TradeoffReport r = report();
  r.rows[0].psnr_db = std::numeric_limits<double>::infinity();
  r.rows[0].rmse = 0.0;
  const auto j = nlohmann::json::parse(tradeoff_json(r));
  EXPECT_EQ(j["version"], 1);
  EXPECT_TRUE(j["rows"][0]["psnr_db"].is_null());
  EXPECT_EQ(j["rows"].size(), r.rows.size());
  EXPECT_EQ(j["dof_for_target"]["bound"], "about");
}

// The schema names the very keys that are written.
TEST(TradeoffFiles, TheSchemaNamesTheKeys) {
  std::ifstream file(std::string(VERGENCE_ASSETS) + "/schemas/tradeoff-output.schema.json");
  const auto schema = nlohmann::json::parse(file);
  const auto keys = [](const nlohmann::json& object) {
    std::set<std::string> names;
    for (const auto& [key, value] : object.items()) {
      names.insert(key);
    }
    return names;
  };
  const auto j = nlohmann::json::parse(tradeoff_json(report()));
  EXPECT_EQ(keys(j), keys(schema["properties"]));
  EXPECT_EQ(keys(j["rows"][0]), keys(schema["$defs"]["row"]["properties"]));
  EXPECT_EQ(keys(j["lens_iterations"]), keys(schema["properties"]["lens_iterations"]["properties"]));
}

TEST(TradeoffFiles, ThePageEscapesAndShowsEachPicture) {
  const std::string page = tradeoff_page(report());
  EXPECT_NE(page.find("room &lt;1&gt;.glb"), std::string::npos);
  for (const char* file : {"tradeoff.svg", "tradeoff.csv", "picture_reference.png", "picture_dof-64.png",
                           "difference_dof-64.png", "picture_vis.png"}) {
    EXPECT_NE(page.find(file), std::string::npos) << file;
  }
  EXPECT_EQ(page.find("difference_vis.png"), std::string::npos) << "a map has no difference";
}

TEST(TradeoffFiles, DifferencesAreEnlargedAndBounded) {
  const render::Image8 a{2, 1, {100, 100, 100, 0, 0, 0}}, b{2, 1, {103, 98, 100, 255, 0, 10}};
  EXPECT_EQ(app::difference_image(a, b).rgb, (std::vector<std::uint8_t>{24, 16, 0, 255, 0, 80}));
}

struct Box {
  int x, y, width;
};

Box box_of(const app::Drawing::Text& text) {
  const int width = app::drawn_width(text.text);
  const int left = text.anchor == app::Drawing::Anchor::left     ? text.x
                   : text.anchor == app::Drawing::Anchor::middle ? text.x - width / 2
                                                                 : text.x - width;
  return {left, text.y, width};
}

// Many settings in one place, as ways to trace a lens are.
TEST(TradeoffChart, LabelsDoNotCoverEachOther) {
  TradeoffReport r = report();
  for (int i = 0; i < 24; ++i) {
    r.rows.push_back(row("setting-number-" + std::to_string(i), 95.0 + i % 7, 0.0101 + 0.0001 * i));
  }
  mark_efficient(r.rows);
  const app::Drawing chart = tradeoff_chart(r);
  std::size_t labels = 0;
  for (std::size_t i = 0; i < chart.texts.size(); ++i) {
    labels += chart.texts[i].text.starts_with("setting-number-") ? 1 : 0;
    const Box a = box_of(chart.texts[i]);
    EXPECT_TRUE(a.x >= 0 && a.x + a.width <= chart.width && a.y >= 0 && a.y + app::kDrawnTextHeight <= chart.height)
        << chart.texts[i].text;
    for (std::size_t k = 0; k < i; ++k) {
      const Box b = box_of(chart.texts[k]);
      const bool apart = a.x >= b.x + b.width || b.x >= a.x + a.width || a.y >= b.y + app::kDrawnTextHeight ||
                         b.y >= a.y + app::kDrawnTextHeight;
      EXPECT_TRUE(apart) << chart.texts[i].text << " and " << chart.texts[k].text;
    }
  }
  EXPECT_GE(labels, 40U) << "of 48 in two plots";
}

TEST(TradeoffChart, MarksThePapersModesAndDrawsInBothWays) {
  const app::Drawing chart = tradeoff_chart(report());
  const std::string svg = to_svg(chart);
  for (const char* name : {"PIN (pinhole)", "VIS (a map)", "ADOF (standard)", "DOF (dof-1)"}) {
    EXPECT_NE(svg.find(name), std::string::npos) << name;
  }
  const render::Image8 image = to_image(chart);
  EXPECT_EQ(image.width, chart.width);
  EXPECT_EQ(image.height, chart.height);
  EXPECT_TRUE(std::ranges::any_of(image.rgb, [](std::uint8_t v) { return v < 100; }));
}

// A single row, one without a picture, and one without error have charts too.
TEST(TradeoffChart, FewRowsAreNoTrouble) {
  TradeoffReport r = report();
  for (const std::vector<TradeoffRow>& rows :
       {std::vector{row("standard", 10.0, 0.01)}, std::vector{row("vis", 10.0, std::nullopt, "power")},
        std::vector{row("standard", 0.0, 0.0)}}) {
    r.rows = rows;
    mark_efficient(r.rows);
    const render::Image8 image = to_image(tradeoff_chart(r));
    EXPECT_GT(image.width * image.height, 0);
    EXPECT_FALSE(tradeoff_table(r).empty());
  }
}

TEST(LogTicks, AreRound) {
  EXPECT_EQ(app::log_ticks(0.9, 60.0, 12), (std::vector<double>{1, 2, 5, 10, 20, 50}));
  EXPECT_EQ(app::log_ticks(0.5, 5e6, 10).size(), 7U) << "powers of ten alone";
}

}  // namespace
