#include "app/bench/bench_growth.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

#include "app/bench/bench_text.hpp"

namespace app {
namespace {

struct Line {
  double at_zero, slope;
};

// Least squares of weight * (y - line(x)).
template <class X, class Y, class Weight>
Line fit_line(std::span<const GrowthPoint> points, X&& x, Y&& y, Weight&& weight) {
  double s = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const GrowthPoint& p : points) {
    const double w = weight(p) * weight(p);
    s += w;
    sx += w * x(p);
    sy += w * y(p);
    sxx += w * x(p) * x(p);
    sxy += w * x(p) * y(p);
  }
  const double slope = (s * sxy - sx * sy) / (s * sxx - sx * sx);
  return {(sy - slope * sx) / s, slope};
}

const BenchRow* same_row(const BenchReport& report, const BenchRow& row, int size) {
  const auto found = std::ranges::find_if(report.rows, [&](const BenchRow& r) {
    return r.lens == row.lens && r.mode == row.mode && r.shading == row.shading && r.size == size;
  });
  return found == report.rows.end() ? nullptr : &*found;
}

std::string growth_line(const BenchReport& report, const BenchRow& row, const std::set<int>& sizes) {
  std::string out =
      format("%-*s %-5s%-5s", lens_width(report), row.lens.c_str(), row.mode.c_str(), row.shading.c_str());
  std::vector<GrowthPoint> points;
  for (const int size : sizes) {
    const BenchRow* here = same_row(report, row, size);
    const double ns = here == nullptr ? 0.0 : here->ms.median * 1e6 / here->pixels();
    if (ns > 0.0) {
      points.push_back({here->pixels(), here->ms.median});
    }
    out += format(" %9.1f", ns);
  }
  if (points.size() < 2) {
    return out + "\n";
  }
  const double ratio = points.back().ms / points.back().pixels * points.front().pixels / points.front().ms;
  const GrowthFit fit = fit_growth(points);
  out += format(" %8.2f %9.2f", ratio, fit.exponent);
  // A line through two points departs from neither.
  return out + (points.size() < 3 ? "\n"
                                  : format("   %.2f + %.2f a megapixel, within %.1f %%\n", fit.fixed_ms,
                                           fit.ms_a_megapixel, 100.0 * fit.largest_departure));
}

}  // namespace

GrowthFit fit_growth(std::span<const GrowthPoint> points) {
  if (points.size() < 2) {
    throw std::invalid_argument("a line needs two points");
  }
  const auto megapixels = [](const GrowthPoint& p) { return 1e-6 * p.pixels; };
  const auto ms = [](const GrowthPoint& p) { return p.ms; };
  const Line line = fit_line(points, megapixels, ms, [](const GrowthPoint& p) { return 1.0 / p.ms; });
  GrowthFit fit{line.at_zero, line.slope, 0.0, 0.0};
  for (const GrowthPoint& p : points) {
    const double expected = line.at_zero + line.slope * megapixels(p);
    fit.largest_departure = std::max(fit.largest_departure, std::abs(p.ms / expected - 1.0));
  }
  fit.exponent = fit_line(
                     points, [](const GrowthPoint& p) { return std::log(p.pixels); },
                     [](const GrowthPoint& p) { return std::log(p.ms); }, [](const GrowthPoint&) { return 1.0; })
                     .slope;
  return fit;
}

std::string growth_table(const BenchReport& report) {
  std::set<int> sizes;
  for (const BenchRow& row : report.rows) {
    sizes.insert(row.size);
  }
  if (sizes.size() < 2) {
    return {};
  }
  std::string out =
      "\nNanoseconds a pixel at each size (equal: time grows linearly with pixels), the last over the first, the\n"
      "exponent of ms ~ pixels^exponent, and the line of ms against pixels that comes nearest to all sizes\n";
  out += format("%-*s %-5s%-5s", lens_width(report), "lens", "mode", "");
  for (const int size : sizes) {
    out += format(" %9d", size);
  }
  out += "    ratio  exponent   ms\n";
  for (const BenchRow& row : report.rows) {
    if (row.size == *sizes.begin()) {
      out += growth_line(report, row, sizes);
    }
  }
  return out;
}

}  // namespace app
