// The latency of pictures in the headset: what lies between the runtime's word that a frame may begin and its picture,
// part by part.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/bench_run.hpp"
#include "app/vr/options.hpp"
#include "app/vr/report.hpp"

namespace app {

struct BenchVrRow {
  std::string lens, mode;
  VrReport session;
};

struct BenchVrConfig {
  std::vector<BenchLens> lenses;
  std::vector<std::string> modes;  // of kBenchModes
  VrOptions session;               // its spectacles and mode do not count; frames: of each row
};

// A session a row, one after the other. Throws as run_vr does; std::runtime_error where a session ended before its last
// frame.
[[nodiscard]] std::vector<BenchVrRow> run_bench_vr(const BenchVrConfig& config,
                                                   const std::function<void(const BenchVrRow&)>& progress);

[[nodiscard]] std::string bench_vr_table(const std::vector<BenchVrRow>& rows);
[[nodiscard]] std::string bench_vr_json(const std::vector<BenchVrRow>& rows);

}  // namespace app
