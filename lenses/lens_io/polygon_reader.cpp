#include "lenses/lens_io/polygon_reader.hpp"

#include <cmath>

namespace lenses::io {
namespace {

constexpr double kReachMm = 500.0;
constexpr double kLeastDoubledArea = 1e-12;  // m^2

}  // namespace

std::vector<glm::dvec2> read_polygon(const Field& polygon, std::size_t most) {
  std::vector<glm::dvec2> points;
  for (const Field& point : polygon.elements(3, most, "[x, y] points")) {
    points.push_back(point.pair(millimetres(-kReachMm, kReachMm)));
  }
  double doubled_area = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec2 &a = points[i], &b = points[(i + 1) % points.size()];
    doubled_area += a.x * b.y - a.y * b.x;
  }
  if (std::abs(doubled_area) < kLeastDoubledArea) {
    polygon.fail("encloses no area; at least 3 points off one line are needed");
  }
  return points;
}

}  // namespace lenses::io
