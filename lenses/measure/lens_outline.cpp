#include "lenses/measure/lens_outline.hpp"

#include <cmath>
#include <numbers>

namespace lenses {
namespace {

bool inside(const std::vector<glm::dvec2>& polygon, const glm::dvec2& point) {
  bool in = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
      in = !in;
    }
  }
  return in;
}

bool in_segment(const Surface& surface, const glm::dvec2& point) {
  const auto* segmented = std::get_if<SegmentedSurface>(&surface);
  return segmented != nullptr && inside(segmented->boundary, point);
}

}  // namespace

std::vector<glm::dvec2> blank_of(const Lens& lens) {
  constexpr int kPoints = 360;
  std::vector<glm::dvec2> circle;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPoints;
    circle.push_back(0.5 * lens.diameter * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return circle;
}

std::vector<glm::dvec2> edge_of(const Lens& lens) {
  return lens.outline.empty() ? blank_of(lens) : lens.outline;
}

int zone_of(const Lens& lens, const glm::dvec2& back_point, const glm::dvec2& front_point) {
  return (in_segment(lens.back, back_point) ? 1 : 0) + (in_segment(lens.front, front_point) ? 2 : 0);
}

}  // namespace lenses
