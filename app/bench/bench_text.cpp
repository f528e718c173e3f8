#include "app/bench/bench_text.hpp"

#include <algorithm>

namespace app {

int lens_width(const BenchReport& report) {
  std::size_t width = 16;
  for (const BenchRow& row : report.rows) {
    width = std::max(width, row.lens.size());
  }
  return static_cast<int>(width);
}

}  // namespace app
