#include "render/wavefront_error.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/lens_forms/view_direction.hpp"

namespace render {
namespace {

namespace f64 = lenses::f64;

double percentile_99(std::vector<double>& values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace

WavefrontReference::WavefrontReference(const lenses::LensModel& lenses, const ViewSetup& view, int width, int height,
                                       std::size_t most) {
  const double pixels = static_cast<double>(width) * height;
  const int step = std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / static_cast<double>(most)))));
  const f64::Table table{lenses.table};
  const f64::LensData& lens = lenses.lens[view.lens];
  const glm::dvec3 gaze = glm::normalize(view.view.gaze);
  for (int y = step / 2; y < height; y += step) {
    for (int x = step / 2; x < width; x += step) {
      const glm::dvec3 direction = view_direction(view, {(x + 0.5) / width, (y + 0.5) / height});
      const glm::dmat3 turn = f64::eye_turn(static_cast<int>(view.viewing), gaze, direction);
      const f64::SightLine line =
          f64::trace_sight_line(table, lens, view.eye, turn, direction, glm::dvec2(0.0), glm::dvec2(0.0));
      const bool through = line.status == f64::kStatusOk;
      if (through || line.status == f64::kStatusMissBack) {
        points_.push_back({static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x),
                           through, through ? f64::sight_line_transfer(lens, line) : f64::free_flight(0.0)});
      }
    }
  }
}

void WavefrontReference::append_differences(const WavefrontPlanes& planes, std::vector<double>& power,
                                            std::vector<double>& astigmatism) const {
  for (const Point& point : points_) {
    const double depth = planes.depth[point.pixel];
    if (depth < 0.0) {
      continue;
    }
    const double q = depth > 0.0 ? 1.0 / std::max(depth, 1e-6) : 0.0;
    glm::dvec3 v(-q, 0.0, -q);
    if (point.through_lens) {
      int status = f64::kStatusOk;
      v = f64::sight_line_vergence(point.transfer, q, status);
      if (status != f64::kStatusOk) {
        continue;
      }
    }
    const double hh = planes.v_hh[point.pixel], hv = planes.v_hv[point.pixel], vv = planes.v_vv[point.pixel];
    power.push_back(std::abs(0.5 * (hh + vv) - 0.5 * (v.x + v.z)));
    astigmatism.push_back(std::abs(std::hypot(hh - vv, 2.0 * hv) - std::hypot(v.x - v.z, 2.0 * v.y)));
  }
}

std::optional<WavefrontError> wavefront_error(std::vector<double> power, std::vector<double> astigmatism) {
  if (power.empty()) {
    return std::nullopt;
  }
  return WavefrontError{percentile_99(power), percentile_99(astigmatism)};
}

}  // namespace render
