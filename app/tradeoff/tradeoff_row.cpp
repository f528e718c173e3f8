#include "app/tradeoff/tradeoff_row.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/report/csv.hpp"
#include "app/report/text.hpp"
#include "app/tradeoff/tradeoff_advice.hpp"

namespace app {
namespace {

// Errors go down to 1e-12 D: six digits that count instead of six decimals. Nothing for what is not there or infinite.
std::string six_digits(std::optional<double> value) {
  return value && std::isfinite(*value) ? format("%.6g", *value) : "";
}

bool beats(const TradeoffRow& a, const TradeoffRow& b) {
  return a.ms.median <= b.ms.median && *a.rmse <= *b.rmse && (a.ms.median < b.ms.median || *a.rmse < *b.rmse);
}

using Json = nlohmann::ordered_json;

Json number_or_null(std::optional<double> value) {
  return value && std::isfinite(*value) ? Json(*value) : Json();
}

}  // namespace

void mark_efficient(std::vector<TradeoffRow>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].efficient = rows[i].rmse.has_value();
    for (std::size_t k = 0; k < rows.size() && rows[i].efficient; ++k) {
      const bool comparable = k != i && rows[k].rmse;
      const bool twin = comparable && k < i && rows[k].ms.median == rows[i].ms.median && *rows[k].rmse == *rows[i].rmse;
      rows[i].efficient = !(comparable && (beats(rows[k], rows[i]) || twin));
    }
  }
}

std::vector<const TradeoffRow*> efficient_rows(std::span<const TradeoffRow> rows) {
  std::vector<const TradeoffRow*> line;
  for (const TradeoffRow& row : rows) {
    if (row.efficient) {
      line.push_back(&row);
    }
  }
  std::ranges::sort(line, {}, [](const TradeoffRow* row) { return row->ms.median; });
  return line;
}

const TradeoffRow* find_row(std::span<const TradeoffRow> rows, const std::string& setting) {
  const auto found = std::ranges::find(rows, setting, &TradeoffRow::setting);
  return found == rows.end() ? nullptr : &*found;
}

std::optional<DofNeed> dof_need(std::span<const TradeoffRow> rows, double rmse) {
  std::vector<const TradeoffRow*> dof;
  for (const TradeoffRow& row : rows) {
    if (row.mode == "dof" && row.rmse) {
      dof.push_back(&row);
    }
  }
  if (dof.empty()) {
    return std::nullopt;
  }
  std::ranges::sort(dof, {}, &TradeoffRow::samples);
  const auto enough = std::ranges::find_if(dof, [&](const TradeoffRow* row) { return *row->rmse <= rmse; });
  if (enough == dof.end()) {
    return DofNeed{.samples = double(dof.back()->samples), .ms = dof.back()->ms.median, .more_than = true};
  }
  if (enough == dof.begin()) {
    return DofNeed{.samples = double(dof.front()->samples), .ms = dof.front()->ms.median, .at_most = true};
  }
  const TradeoffRow &low = **(enough - 1), &high = **enough;
  const double share = std::log(*low.rmse / rmse) / std::log(*low.rmse / std::max(*high.rmse, 1e-12));
  const double samples = low.samples * std::pow(double(high.samples) / low.samples, share);
  const double part = (samples - low.samples) / (high.samples - low.samples);  // time is a straight line of samples
  return DofNeed{.samples = samples, .ms = low.ms.median + part * (high.ms.median - low.ms.median)};
}

std::string tradeoff_csv(std::span<const TradeoffRow> rows) {
  Csv csv(
      "setting,samples,time_ms,time_ms_min,time_ms_max,rmse,psnr_db,power_error_D_p99,astigmatism_error_D_p99,flip,"
      "efficient,mode,subject,rounds,stages_ms");
  for (const TradeoffRow& row : rows) {
    std::string stages;
    for (const auto& [name, ms] : row.stages) {
      stages += (stages.empty() ? "" : "; ") + name + " " + format("%.3f", ms);
    }
    csv.add(row.setting).add(std::to_string(row.samples));
    csv.add(row.ms.median).add(row.ms.min).add(row.ms.max);
    csv.add(six_digits(row.rmse)).add(six_digits(row.psnr_db));
    csv.add(six_digits(row.power_error_D_p99)).add(six_digits(row.astigmatism_error_D_p99));
    csv.add(six_digits(row.flip)).add(row.efficient ? "yes" : "no").add(row.mode).add(row.subject);
    csv.add(std::to_string(row.rounds)).add(stages);
    csv.end_row();
  }
  return csv.text();
}

std::string tradeoff_json(const TradeoffReport& report) {
  Json j{{"version", 1},
         {"scene", report.scene},
         {"wearer", report.wearer},
         {"spectacles", report.spectacles},
         {"device", report.device},
         {"size", {report.width, report.height}},
         {"fov_deg", report.fov_deg},
         {"pixels_per_degree", report.pixels_per_degree},
         {"reference", {{"samples", report.reference_samples}, {"from_cache", report.reference_kept}}},
         {"rows", Json::array()}};
  for (const TradeoffRow& row : report.rows) {
    Json r{{"setting", row.setting},
           {"subject", row.subject},
           {"mode", row.mode},
           {"samples", row.samples},
           {"time_ms", row.ms.median},
           {"time_ms_min", row.ms.min},
           {"time_ms_max", row.ms.max},
           {"rounds", row.rounds},
           {"rmse", number_or_null(row.rmse)},
           {"psnr_db", number_or_null(row.psnr_db)},
           {"flip", number_or_null(row.flip)},
           {"power_error_D_p99", number_or_null(row.power_error_D_p99)},
           {"astigmatism_error_D_p99", number_or_null(row.astigmatism_error_D_p99)},
           {"efficient", row.efficient},
           {"stages_ms", Json::object()}};
    for (const auto& [name, ms] : row.stages) {
      r["stages_ms"][name] = ms;
    }
    j["rows"].push_back(std::move(r));
  }
  j["left_out"] = report.left_out;
  Json& dof = j["dof_for_target"];
  if (const auto need = dof_need(report.rows, report.target_rmse)) {
    dof = {{"rmse", report.target_rmse},
           {"samples", need->samples},
           {"time_ms", need->ms},
           {"bound", need->more_than ? "more_than"
                     : need->at_most ? "at_most"
                                     : "about"}};
  }
  j["lens_iterations"] = {{"surfaces_after_steps", report.iterations.surfaces},
                          {"searched", report.iterations.searched},
                          {"closed_form", report.iterations.closed_form}};
  j["advice"] = advice(report);
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace app
