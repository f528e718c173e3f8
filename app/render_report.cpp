#include "app/render_report.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "lenses/trace.hpp"
#include "render/image/output_file.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kArcminutes = 60.0 * kDegrees;
constexpr const char* kTimingsHeader = "output,mode,width,height,views,triangles,stage,ms_median,ms_min,ms_max,device";

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    out += c == '"' ? "\"\"" : std::string(1, c);
  }
  return out + "\"";
}

SightRow sight_row(const RenderSetup& setup, const WornPair& pair, std::size_t side) {
  const render::LineOfSight& line = pair.fixation.line[side];
  const render::EyeOptics& eye = pair.eyes[side];
  SightRow row;
  row.pair = pair.name;
  row.eye = side == 0 ? "right" : "left";
  row.yaw_deg = std::atan2(line.gaze.x, -line.gaze.z) * kDegrees;
  row.pitch_deg = std::asin(std::clamp(line.gaze.y, -1.0, 1.0)) * kDegrees;
  row.distance_m = pair.fixation.distance;
  row.demand_D = pair.fixation.demand[side];
  const double q = 1.0 / std::max(glm::length(line.point - line.start), 1e-6);
  const lenses::f64::TraceInput ray{glm::dvec4(line.gaze, q), glm::dvec4(line.gaze, 0.0),
                                    glm::ivec4(0, 0, static_cast<int>(setup.viewing), 0)};
  lenses::f64::LensData lens = eye.lens;
  if (!line.through_lens) {
    lens.glass.w = 0.0;
  }
  const auto record = lenses::f64::trace_record(lenses::f64::Table{setup.lenses.table}, lens, eye.eye, ray);
  const auto result = lenses::to_result(record, ray, line.through_lens);
  row.status = lenses::name(result.status);
  row.power_D = result.power;
  row.astigmatism_D = result.astigmatism;
  row.accommodation_D =
      setup.viewing == render::Viewing::gaze ? pair.fixation.accommodation[side] : result.accommodation;
  const auto response = lenses::f64::eye_response(result.vergence, eye.eye, row.accommodation_D);
  row.residual_D = 0.5 * (response.residual.x + response.residual.z);
  row.blur_major_arcmin = response.blur.x * kArcminutes;
  row.blur_minor_arcmin = response.blur.y * kArcminutes;
  return row;
}

// The table so far, or the header of a new one.
std::string read_timings(const std::string& file) {
  if (!std::filesystem::exists(file)) {
    return std::string(kTimingsHeader) + "\n";
  }
  std::ifstream old(file, std::ios::binary);
  if (!old || !std::filesystem::is_regular_file(file)) {
    throw tracking::InputError(file, "", "cannot be read; an earlier timing table or no file is expected");
  }
  std::string text(std::istreambuf_iterator<char>(old), {});
  if (!text.starts_with(kTimingsHeader)) {
    throw tracking::InputError(file, "", "is not a timing table of vergence; name another file or move it away");
  }
  return text;
}

std::string fixed_number(double value, int digits, int width) {
  std::ostringstream text;
  text << std::setw(width) << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

std::string distance_text(double metres) {
  if (!std::isfinite(metres)) {
    return "     sky";
  }
  return fixed_number(metres, metres < 10.0 ? 3 : 1, 8);
}

}  // namespace

std::vector<SightRow> sight_rows(const RenderSetup& setup) {
  std::vector<SightRow> rows;
  for (const WornPair& pair : setup.pairs) {
    for (const tracking::Side side : setup.sides) {
      rows.push_back(sight_row(setup, pair, static_cast<std::size_t>(side)));
    }
  }
  return rows;
}

std::vector<StageRow> stage_rows(const std::vector<std::vector<render::vk::StageTime>>& runs) {
  std::vector<StageRow> rows;
  if (runs.empty()) {
    return rows;
  }
  const auto add = [&](const std::string& name, std::vector<double> times) {
    std::ranges::sort(times);
    rows.push_back({name, times[times.size() / 2], times.front(), times.back()});
  };
  std::vector<double> totals(runs.size(), 0.0);
  for (std::size_t s = 0; s < runs.front().size(); ++s) {
    std::vector<double> times;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      times.push_back(runs[r][s].milliseconds);
      totals[r] += runs[r][s].milliseconds;
    }
    add(runs.front()[s].name, times);
  }
  add("total", totals);
  return rows;
}

std::string to_table(const RenderReport& report) {
  std::ostringstream out;
  out << report.output << ": " << report.mode << ", " << report.views << " x " << report.width << "x" << report.height
      << ", " << report.triangles << " triangles, " << report.device << "\n";
  if (report.samples > 1) {
    out << report.samples << " samples a pixel, standard error " << report.error_estimate << " of the mean luminance\n";
  }
  if (report.is_map) {
    out << "map from " << report.range_low << " to " << report.range_high << " " << report.range_unit << "\n";
  }
  out << "\neye    gaze yaw,pitch deg  fixation m  power D  astig D  demand D  accomm D  residual D  blur arcmin  "
         "pair\n";
  for (const SightRow& row : report.sight) {
    out << std::left << std::setw(6) << row.eye << std::right << fixed_number(row.yaw_deg, 2, 9) << ","
        << fixed_number(row.pitch_deg, 2, 7) << "    " << distance_text(row.distance_m)
        << fixed_number(row.power_D, 2, 11) << fixed_number(row.astigmatism_D, 2, 9)
        << fixed_number(row.demand_D, 2, 10) << fixed_number(row.accommodation_D, 2, 10)
        << fixed_number(row.residual_D, 2, 12) << fixed_number(row.blur_major_arcmin, 1, 7) << " x"
        << fixed_number(row.blur_minor_arcmin, 1, 5) << "  " << row.pair
        << (row.status == "ok" ? "" : " (" + row.status + ")") << "\n";
  }
  if (!report.findings.empty()) {
    out << "\n" << to_table(report.findings);
  }
  out << "\nstage      median ms     min ms     max ms\n";
  for (const StageRow& row : report.stages) {
    out << std::left << std::setw(8) << row.stage << std::right << fixed_number(row.median_ms, 2, 12)
        << fixed_number(row.min_ms, 2, 11) << fixed_number(row.max_ms, 2, 11) << "\n";
  }
  out << "\nstart-up ms:";
  for (const auto& [name, ms] : report.start_up) {
    out << (name == report.start_up.front().first ? " " : ", ") << name << " " << fixed_number(ms, 0, 0);
  }
  out << "; peak memory " << fixed_number(report.peak_memory_mib, 0, 0) << " MiB\n";
  return out.str();
}

std::string to_json(const RenderReport& report) {
  nlohmann::ordered_json j;
  j["output"] = report.output;
  j["mode"] = report.mode;
  j["size"] = {report.width, report.height};
  j["views"] = report.views;
  j["triangles"] = report.triangles;
  j["device"] = report.device;
  j["samples"] = report.samples;
  j["error_estimate"] = report.error_estimate;
  if (report.is_map) {
    j["range"] = {report.range_low, report.range_high};
    j["range_unit"] = report.range_unit;
  }
  for (const SightRow& row : report.sight) {
    nlohmann::ordered_json s;
    s["pair"] = row.pair;
    s["eye"] = row.eye;
    s["gaze_deg"] = {row.yaw_deg, row.pitch_deg};
    s["fixation_m"] = std::isfinite(row.distance_m) ? nlohmann::ordered_json(row.distance_m) : nlohmann::ordered_json();
    s["status"] = row.status;
    s["power_D"] = row.power_D;
    s["astigmatism_D"] = row.astigmatism_D;
    s["demand_D"] = row.demand_D;
    s["accommodation_D"] = row.accommodation_D;
    s["residual_D"] = row.residual_D;
    s["blur_arcmin"] = {row.blur_major_arcmin, row.blur_minor_arcmin};
    j["sight"].push_back(s);
  }
  if (!report.findings.empty()) {
    j["findings"] = to_json_array(report.findings);
  }
  for (const auto& [name, ms] : report.start_up) {
    j["start_up_ms"][name] = ms;
  }
  j["peak_memory_MiB"] = report.peak_memory_mib;
  for (const StageRow& row : report.stages) {
    j["stages_ms"][row.stage] = {{"median", row.median_ms}, {"min", row.min_ms}, {"max", row.max_ms}};
  }
  // A file's name may be bytes that are not UTF-8.
  return j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void check_timings(const std::string& file) {
  static_cast<void>(read_timings(file));
}

void append_timings(const std::string& file, const RenderReport& report) {
  std::string text = read_timings(file);
  std::vector<StageRow> stages;
  for (const auto& [name, ms] : report.start_up) {
    stages.push_back({"start: " + name, ms, ms, ms});
  }
  stages.insert(stages.end(), report.stages.begin(), report.stages.end());
  std::ostringstream rows;
  for (const StageRow& row : stages) {
    rows << quoted(report.output) << ',' << report.mode << ',' << report.width << ',' << report.height << ','
         << report.views << ',' << report.triangles << ',' << row.stage << ',' << row.median_ms << ',' << row.min_ms
         << ',' << row.max_ms << ',' << quoted(report.device) << '\n';
  }
  text += rows.str();
  render::write_file(file, std::as_bytes(std::span(text)));
}

}  // namespace app
