// How a row's time grows with the picture: nanoseconds a pixel, and a straight line of milliseconds against pixels.
#pragma once

#include <span>
#include <string>

#include "app/bench/bench_report.hpp"

namespace app {

struct GrowthPoint {
  double pixels = 0.0, ms = 0.0;  // both above 0
};

struct GrowthFit {
  double fixed_ms = 0.0, ms_a_megapixel = 0.0;  // ms = fixed + slope * megapixels, least squares of relative errors
  double largest_departure = 0.0;               // of a measured time from that line, over the line's
  double exponent = 0.0;                        // ms ~ pixels^exponent, least squares of logarithms; 1: linear
};

// Of at least two points of different pixels.
[[nodiscard]] GrowthFit fit_growth(std::span<const GrowthPoint> points);

// A line a lens, mode and shading; empty for a report of one size.
[[nodiscard]] std::string growth_table(const BenchReport& report);

}  // namespace app
