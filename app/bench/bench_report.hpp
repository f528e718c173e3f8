// The benchmark as text and as a page, which shows bench.svg.
#pragma once

#include <span>
#include <string>

#include "app/bench/bench_row.hpp"

namespace app {

struct BenchReport {
  std::string scene, device;
  std::size_t triangles = 0;
  double gflops = 0.0, gigabytes_per_s = 0.0;  // measured; 0: unknown
  bool on_processor = false;  // the device is the CPU: processor time is its own, whatever else the machine does
  unsigned peer_threads = 0;
  int rounds = 0;
  std::vector<BenchRow> rows;
  std::vector<PeerRow> peers;
};

[[nodiscard]] std::string bench_table(const BenchReport& report);
[[nodiscard]] std::string bench_page(const BenchReport& report);

}  // namespace app
