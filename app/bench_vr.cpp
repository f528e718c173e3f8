#include "app/bench_vr.hpp"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "app/vr/run.hpp"

namespace app {
namespace {

// What --mode of the other commands calls a mode of the benchmark's.
std::string session_mode(const std::string& mode) {
  return mode == "vis" ? "power" : mode == "pin" ? "pinhole" : mode;
}

void print(std::ostream& out, const std::string& name, const TimeRing& times, double period_ms) {
  out << "  " << std::left << std::setw(26) << name << std::right << std::fixed << std::setprecision(3) << std::setw(10)
      << times.quantile(0.5) << std::setw(10) << times.quantile(0.99);
  if (period_ms > 0.0) {
    out << std::setprecision(1) << std::setw(9) << 100.0 * times.quantile(0.5) / period_ms << " %";
  }
  out << '\n';
}

}  // namespace

std::vector<BenchVrRow> run_bench_vr(const BenchVrConfig& config,
                                     const std::function<void(const BenchVrRow&)>& progress) {
  std::vector<BenchVrRow> rows;
  for (const BenchLens& lens : config.lenses) {
    for (const std::string& mode : config.modes) {
      BenchVrRow& row = rows.emplace_back(BenchVrRow{lens.name, mode, {}});
      progress(row);
      VrOptions options = config.session;
      options.scene.spectacles = lens.spectacles;
      options.mode = session_mode(mode);
      row.session = run_vr(options);
      if (row.session.shown < config.session.frames.value_or(0)) {
        throw std::runtime_error("the session ended after " + std::to_string(row.session.shown) + " of " +
                                 std::to_string(*config.session.frames) + " frames");
      }
    }
  }
  return rows;
}

std::string bench_vr_table(const std::vector<BenchVrRow>& rows) {
  std::ostringstream out;
  if (!rows.empty()) {
    const VrReport& any = rows.front().session;
    out << "runtime " << any.runtime << "\nheadset " << any.headset << "\ndevice  " << any.device << "\n";
  }
  for (const BenchVrRow& row : rows) {
    const VrReport& session = row.session;
    const double period_ms = 1e3 * session.period;
    out << '\n'
        << row.lens << ", " << row.mode << ", " << session.width << 'x' << session.height << " each eye, "
        << session.shown << " frames, " << std::fixed << std::setprecision(1) << period_ms << " ms a frame\n"
        << "                             ms median       p99   of a frame\n";
    for (const auto& [name, times] : session.host) {
      print(out, name, times, period_ms);
    }
    print(out, "xrWaitFrame to submit", session.wait_to_submit, period_ms);
    print(out, "processor, without waits", session.frame_code, period_ms);
    for (const auto& [name, times] : session.device_stages) {
      print(out, "device: " + name, times, period_ms);
    }
  }
  return out.str();
}

std::string bench_vr_json(const std::vector<BenchVrRow>& rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const BenchVrRow& row : rows) {
    nlohmann::ordered_json one{{"lens", row.lens}, {"mode", row.mode}};
    one.update(nlohmann::ordered_json::parse(to_json(row.session)));
    json.push_back(std::move(one));
  }
  return json.dump(2) + "\n";
}

}  // namespace app
