// Words of the report.
#pragma once

#include "app/bench/bench_report.hpp"
#include "app/report/html.hpp"
#include "app/report/text.hpp"

namespace app {

// Of the column that holds a report's longest name.
[[nodiscard]] int lens_width(const BenchReport& report);

}  // namespace app
