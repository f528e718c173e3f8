#include "app/tradeoff/tradeoff_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/report/text.hpp"

namespace app {
namespace {

// Distinct to colour-blind readers too (Okabe and Ito 2008), black first; then darker ones of the same hues.
constexpr std::array<render::Rgb, 12> kColours{{{0, 0, 0},
                                                {0, 114, 178},
                                                {213, 94, 0},
                                                {0, 158, 115},
                                                {204, 121, 167},
                                                {230, 159, 0},
                                                {86, 180, 233},
                                                {148, 130, 20},
                                                {120, 60, 140},
                                                {140, 60, 30},
                                                {90, 110, 60},
                                                {110, 110, 110}}};

// The paper's four modes by its own names.
std::string label_of(const std::string& setting) {
  return setting == "standard"  ? "ADOF (standard)"
         : setting == "pinhole" ? "PIN (pinhole)"
         : setting == "vis"     ? "VIS (a map)"
         : setting == "dof-1"   ? "DOF (dof-1)"
                                : setting;
}

bool is_the_papers(const std::string& setting) {
  return label_of(setting) != setting;
}

// Its subjects in the order of their first rows, each with a colour; the modes of the paper share black.
std::vector<LogPlot::Legend> subjects_of(std::span<const TradeoffRow> rows) {
  std::vector<LogPlot::Legend> subjects{{"the paper's modes", kColours[0]}};
  for (const TradeoffRow& row : rows) {
    const bool known = std::ranges::find(subjects, row.subject, &LogPlot::Legend::name) != subjects.end();
    if (!known && row.subject != "mode" && row.subject != "standard") {
      subjects.push_back({row.subject, kColours[1 + (subjects.size() - 1) % (kColours.size() - 1)]});
    }
  }
  return subjects;
}

render::Rgb colour_of(const TradeoffRow& row, const std::vector<LogPlot::Legend>& subjects) {
  const auto found = std::ranges::find(subjects, row.subject, &LogPlot::Legend::name);
  return found == subjects.end() ? kColours[0] : found->colour;
}

LogPlot::Point point_of(const TradeoffRow& row, double y, const std::vector<LogPlot::Legend>& subjects) {
  constexpr double kLeast_ms = 1e-6;  // a clock may not have moved
  return {.x = std::max(row.ms.median, kLeast_ms),
          .x_low = std::max(row.ms.min, kLeast_ms),
          .x_high = std::max(row.ms.max, kLeast_ms),
          .y = y,
          .label = label_of(row.setting),
          .colour = colour_of(row, subjects),
          .marked = is_the_papers(row.setting)};
}

std::string file_name(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

std::string setting_note(const TradeoffReport& report) {
  return format("%s, %s, %dx%d, %s", file_name(report.scene).c_str(), file_name(report.spectacles).c_str(),
                report.width, report.height, report.device.c_str());
}

LogPlot picture_plot(const TradeoffReport& report, const std::vector<LogPlot::Legend>& subjects) {
  LogPlot plot;
  plot.title =
      format("What accuracy costs: a picture's error against %d rays a pixel, and its time", report.reference_samples);
  plot.note = setting_note(report);
  plot.x_label = "time of a frame, ms (line: least to most of the rounds)";
  plot.y_label = "RMS error of display values";
  plot.legend = subjects;
  double least = 1.0, most = 0.0;
  std::vector<const TradeoffRow*> drawn;
  for (const TradeoffRow& row : report.rows) {
    if (row.rmse && !(*row.rmse > 0.0)) {
      continue;  // nothing is left of its error that a logarithm could show
    }
    plot.points.push_back(point_of(row, row.rmse.value_or(0.0), subjects));
    drawn.push_back(&row);
    if (row.rmse) {
      least = std::min(least, *row.rmse);
      most = std::max(most, *row.rmse);
    }
  }
  for (const TradeoffRow* row : efficient_rows(report.rows)) {
    if (const auto at = std::ranges::find(drawn, row); at != drawn.end()) {
      plot.joined.push_back(static_cast<std::size_t>(at - drawn.begin()));
    }
  }
  const auto psnr = [](double rmse) { return -20.0 * std::log10(rmse); };
  if (most > 0.0) {
    plot.other.push_back({.label = "PSNR, dB",
                          .y_of = [](double db) { return std::pow(10.0, -db / 20.0); },
                          .step = psnr(least) - psnr(most) > 20.0 ? 5.0 : 2.0,
                          .low = psnr(most) - 10.0,
                          .high = psnr(least) + 10.0});
  }
  return plot;
}

// Of the settings that are about the lens, and the paper's modes; the others have the wavefront of `standard`.
LogPlot wavefront_plot(const TradeoffReport& report, const std::vector<LogPlot::Legend>& subjects) {
  LogPlot plot;
  plot.title = "What accuracy costs: the wavefront's error against double precision";
  plot.note = "the larger of power and astigmatism, of the ways to trace the lens";
  plot.x_label = "time of a frame, ms";
  plot.y_label = "99th percentile, D";
  plot.height = 400;
  std::vector<std::size_t> pictures;
  for (const TradeoffRow& row : report.rows) {
    const double error = std::max(row.power_error_D_p99.value_or(0.0), row.astigmatism_error_D_p99.value_or(0.0));
    const bool about_it = row.subject.starts_with("lens") || row.setting == "standard" || row.setting == "vis";
    if (error > 0.0 && about_it) {
      if (row.rmse) {
        pictures.push_back(plot.points.size());
      }
      plot.points.push_back(point_of(row, error, subjects));
    }
  }
  std::ranges::sort(pictures, {}, [&](std::size_t i) { return plot.points[i].x; });
  for (const std::size_t i : pictures) {
    if (plot.joined.empty() || plot.points[i].y < plot.points[plot.joined.back()].y) {
      plot.joined.push_back(i);
    }
  }
  return plot;
}

}  // namespace

Drawing tradeoff_chart(const TradeoffReport& report) {
  const auto subjects = subjects_of(report.rows);
  std::vector<LogPlot> plots{picture_plot(report, subjects), wavefront_plot(report, subjects)};
  if (plots[1].joined.size() < 2 && plots[1].points.size() < 3) {
    plots.pop_back();  // nothing to compare
  }
  return draw_log_plots(plots);
}

}  // namespace app
