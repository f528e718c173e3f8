// Words of the report.
#pragma once

#include <string>

#include "app/bench/bench_report.hpp"

namespace app {

[[gnu::format(printf, 1, 2)]] [[nodiscard]] std::string format(const char* pattern, ...);

// Of the column that holds a report's longest name.
[[nodiscard]] int lens_width(const BenchReport& report);

// For HTML and SVG.
[[nodiscard]] std::string escaped(const std::string& text);

}  // namespace app
