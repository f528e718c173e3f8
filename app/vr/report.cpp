#include "app/vr/report.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace app {
namespace {

using Times = std::vector<std::pair<std::string, TimeRing>>;

TimeRing& find_or_add(Times& times, const std::string& name) {
  const auto found = std::ranges::find(times, name, &Times::value_type::first);
  return found != times.end() ? found->second : times.emplace_back(name, TimeRing{}).second;
}

nlohmann::ordered_json json_of(const TimeRing& ring) {
  return {{"median", ring.quantile(0.5)}, {"p99", ring.quantile(0.99)}, {"max", ring.quantile(1.0)}};
}

nlohmann::ordered_json json_of(const Times& times) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, ring] : times) {
    json[name] = json_of(ring);
  }
  return json;
}

void print(std::ostream& out, const char* where, const std::string& name, const TimeRing& ring) {
  out << std::left << std::setw(8) << where << std::setw(24) << name << std::right << std::setw(10)
      << ring.quantile(0.5) << std::setw(10) << ring.quantile(0.99) << '\n';
}

void print(std::ostream& out, const char* where, const Times& times) {
  for (const auto& [name, ring] : times) {
    print(out, where, name, ring);
  }
}

std::string counts_text(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [what, frames] : counts) {
    text += (text.empty() ? "" : "; ") + what + " (" + std::to_string(frames) + " frames)";
  }
  return text;
}

std::string rungs_text(const VrReport& report) {
  const std::string switched =
      report.rung_switches == 1 ? "1 switch" : std::to_string(report.rung_switches) + " switches";
  return counts_text(report.rungs) + ", " + switched + ", the last because of: " + report.rung_reason;
}

}  // namespace

void TimeRing::add(double value) {
  if (times_.size() < kMost) {
    times_.push_back(value);
  } else {
    times_[next_] = value;
  }
  next_ = (next_ + 1) % kMost;
}

double TimeRing::quantile(double fraction) const {
  if (times_.empty()) {
    return 0.0;
  }
  std::vector<double> sorted = times_;
  const auto at =
      sorted.begin() + static_cast<std::ptrdiff_t>(std::lround(fraction * static_cast<double>(sorted.size() - 1)));
  std::ranges::nth_element(sorted, at);
  return *at;
}

TimeRing& VrReport::host_part(const std::string& name) {
  return find_or_add(host, name);
}

TimeRing& VrReport::device_stage(const std::string& name) {
  return find_or_add(device_stages, name);
}

std::string to_table(const VrReport& report) {
  std::ostringstream out;
  out << "runtime  " << report.runtime << "\nheadset  " << report.headset << "\ndevice   " << report.device
      << "\nspace    " << report.space << "\nimages   " << report.width << 'x' << report.height << " each, and "
      << report.guard_px << " pixels around them\ngaze     " << counts_text(report.gaze_sources) << "\nshown    "
      << counts_text(report.pictures) << "\naccuracy " << rungs_text(report) << "\nframes   " << report.shown
      << " shown, " << report.skipped << " without a picture\n";
  out << to_table(report.findings);
  if (report.reconnections > 0) {
    out << "runtimes " << report.reconnections + 1 << ", the others after a loss\n";
  }
  out << std::fixed << std::setprecision(1);
  if (!report.head_speed.empty()) {
    out << "head     " << report.head_speed.quantile(0.5) << " deg/s (median), " << report.head_speed.quantile(1.0)
        << " at most; reprojected by one frame, a picture behind these lenses is off by "
        << report.reprojection_error.quantile(0.5) << " arcmin (median), " << report.reprojection_error.quantile(1.0)
        << " at most\n";
  }
  out << std::setprecision(3) << "\n                                ms median      p99\n";
  print(out, "host", report.host);
  print(out, "host", "xrWaitFrame to submit", report.wait_to_submit);
  print(out, "host", "processor, without waits", report.frame_code);
  print(out, "device", report.device_stages);
  return out.str();
}

std::string to_json(const VrReport& report) {
  const nlohmann::ordered_json json{{"runtime", report.runtime},
                                    {"headset", report.headset},
                                    {"device", report.device},
                                    {"space", report.space},
                                    {"size", std::to_string(report.width) + "x" + std::to_string(report.height)},
                                    {"guard_px", report.guard_px},
                                    {"period_ms", 1e3 * report.period},
                                    {"gaze_frames", report.gaze_sources},
                                    {"picture_frames", report.pictures},
                                    {"rung_frames", report.rungs},
                                    {"rung_switches", report.rung_switches},
                                    {"rung_reason", report.rung_reason},
                                    {"kernels_late", report.kernels_late},
                                    {"findings", to_json_array(report.findings)},
                                    {"frames_shown", report.shown},
                                    {"frames_skipped", report.skipped},
                                    {"host_ms", json_of(report.host)},
                                    {"wait_to_submit_ms", json_of(report.wait_to_submit)},
                                    {"frame_code_cpu_ms", json_of(report.frame_code)},
                                    {"stages_ms", json_of(report.device_stages)},
                                    {"head_speed_deg_s", json_of(report.head_speed)},
                                    {"reprojection_error_arcmin", json_of(report.reprojection_error)},
                                    {"reconnections", report.reconnections}};
  return json.dump(2) + "\n";
}

}  // namespace app
