#include "app/tradeoff/tradeoff_advice.hpp"

#include <algorithm>
#include <cmath>

#include "app/report/text.hpp"

namespace app {
namespace {

// Less is within what a second run gives.
constexpr double kWorthwhile_db = 0.5;

std::string time_text(double ms) {
  return ms >= 1e4 ? format("%.1f s", 1e-3 * ms) : format(ms >= 100.0 ? "%.0f ms" : "%.3g ms", ms);
}

std::string quality(const TradeoffRow& row) {
  return std::isfinite(*row.psnr_db) ? format("%.1f dB", *row.psnr_db) : "the reference itself";
}

std::string gain(const TradeoffRow& from, const TradeoffRow& to) {
  const double db = *to.psnr_db - *from.psnr_db;
  return std::isfinite(db) ? format("%.1f dB", std::abs(db)) : "all that is left";
}

// "3.2 times the time", "18 % more".
std::string cost(const TradeoffRow& from, const TradeoffRow& to) {
  const double ratio = to.ms.median / std::max(from.ms.median, 1e-9);
  const std::string more = time_text(to.ms.median - from.ms.median) + " more";
  return more + (ratio < 2.0 ? format(" (+%.0f %%)", 100.0 * (ratio - 1.0)) : format(" (%.1f times the time)", ratio));
}

// The first setting of the efficient line that is slower and worthwhile better than `from`.
const TradeoffRow* next_up(const std::vector<const TradeoffRow*>& line, const TradeoffRow& from) {
  const auto found = std::ranges::find_if(line, [&](const TradeoffRow* row) {
    return row->ms.median > from.ms.median && *row->psnr_db >= *from.psnr_db + kWorthwhile_db;
  });
  return found == line.end() ? nullptr : *found;
}

// The best of the line that is at least a tenth faster.
const TradeoffRow* next_down(const std::vector<const TradeoffRow*>& line, const TradeoffRow& from) {
  const TradeoffRow* best = nullptr;
  for (const TradeoffRow* row : line) {
    best = row->ms.median <= 0.9 * from.ms.median ? row : best;
  }
  return best;
}

void advise_on(const TradeoffRow& chosen, const std::vector<const TradeoffRow*>& line, std::vector<std::string>& out) {
  std::string first = chosen.setting + " gives " + quality(chosen) + " for " + time_text(chosen.ms.median) + ";";
  if (const TradeoffRow* up = next_up(line, chosen)) {
    first += " the next step up, " + up->setting + ", costs " + cost(chosen, *up) + " and gains " + gain(chosen, *up);
  } else {
    first += " no setting measured here is better by half a decibel or more";
  }
  out.push_back(first + ".");
  if (const TradeoffRow* down = next_down(line, chosen)) {
    const bool better = *down->psnr_db >= *chosen.psnr_db;
    out.push_back("A step down, " + down->setting + ", takes " + time_text(down->ms.median) +
                  format(" (%.0f %% of it) and ", 100.0 * down->ms.median / chosen.ms.median) +
                  (better ? "loses nothing" : "loses " + gain(chosen, *down)) + ".");
  }
}

std::string dof_sentence(const TradeoffReport& report, const DofNeed& need) {
  const double psnr = -20.0 * std::log10(report.target_rmse);
  const std::string samples = format("%.0f", std::ceil(need.samples));
  std::string out = format("For an error of %.2g (%.1f dB) distributed rays need ", report.target_rmse, psnr);
  out += need.more_than ? "more than " + samples + " samples, which take " + time_text(need.ms)
         : need.at_most
             ? "no more than " + samples + (need.samples == 1.0 ? " sample, " : " samples, ") + time_text(need.ms)
             : "about " + samples + " samples, " + time_text(need.ms);
  const TradeoffRow* chosen = find_row(report.rows, report.accuracy);
  if (chosen != nullptr && chosen->rmse && *chosen->rmse == report.target_rmse && chosen->ms.median > 0.0) {
    out += format(": %.3g times as long as %s with that error", need.ms / chosen->ms.median, chosen->setting.c_str());
  }
  return out + ".";
}

}  // namespace

std::vector<std::string> advice(const TradeoffReport& report) {
  std::vector<std::string> out;
  const auto line = efficient_rows(report.rows);
  const TradeoffRow* chosen = find_row(report.rows, report.accuracy);
  if (chosen != nullptr && chosen->rmse) {
    advise_on(*chosen, line, out);
  }
  const TradeoffRow* last = nullptr;
  std::string steps;
  for (const TradeoffRow* row : line) {
    if (last == nullptr || *row->psnr_db >= *last->psnr_db + kWorthwhile_db) {
      steps += (steps.empty() ? "" : "; ") + row->setting + " " + quality(*row) + ", " + time_text(row->ms.median);
      last = row;
    }
  }
  if (!steps.empty()) {
    out.push_back("Worth taking, from the fastest on: " + steps + ".");
  }
  if (const auto need = dof_need(report.rows, report.target_rmse); need && report.target_rmse > 0.0) {
    out.push_back(dof_sentence(report, *need));
  }
  if (const std::string sentence = iteration_sentence(report.iterations); !sentence.empty()) {
    out.push_back(sentence);
  }
  return out;
}

std::string iteration_sentence(const render::IterationHistogram& iterations) {
  if (iterations.iterated() == 0) {
    return "";
  }
  std::string out = format("Of %zu surfaces met by Newton's method", iterations.iterated());
  for (std::size_t n = 1; n <= 3; ++n) {
    out += format("%s %.4g %% settle within %zu", n == 1 ? "" : ",", 100.0 * iterations.settled_within(n), n);
  }
  return out + " steps; the paper takes three for all.";
}

std::string tradeoff_table(const TradeoffReport& report) {
  std::string out =
      format("%s, %dx%d, %s\nreference: %d samples a pixel%s; FLIP at %.1f pixels a degree\n\n", report.scene.c_str(),
             report.width, report.height, report.device.c_str(), report.reference_samples,
             report.reference_kept ? " (kept from an earlier run)" : "", report.pixels_per_degree);
  std::size_t width = 8;
  for (const TradeoffRow& row : report.rows) {
    width = std::max(width, row.setting.size());
  }
  out += format("%-*s samples  median ms      min      max     rmse  PSNR dB   FLIP  power D p99  astig D p99\n",
                static_cast<int>(width) + 2, "setting");
  const auto cell = [](std::optional<double> value, const char* pattern, int columns) {
    char text[32] = "-";
    if (value) {
      std::snprintf(text, sizeof text, pattern, *value);
    }
    return format("%*s", columns, text);
  };
  for (const TradeoffRow& row : report.rows) {
    out +=
        format("%-*s %7d %10.2f %8.2f %8.2f", static_cast<int>(width) + 2,
               (row.setting + (row.efficient ? " *" : "")).c_str(), row.samples, row.ms.median, row.ms.min, row.ms.max);
    out += cell(row.rmse, "%.5f", 9) + cell(row.psnr_db, "%.2f", 9) + cell(row.flip, "%.4f", 7) +
           cell(row.power_error_D_p99, "%.3g", 13) + cell(row.astigmatism_error_D_p99, "%.3g", 13) + "\n";
  }
  for (const std::string& reason : report.left_out) {
    out += "left out: " + reason + "\n";
  }
  out += "* efficient: nothing measured here is both as fast and as good\n\n";
  for (const std::string& sentence : advice(report)) {
    out += sentence + "\n";
  }
  return out;
}

}  // namespace app
