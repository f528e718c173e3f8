#include "lenses/measure/lens_outline.hpp"

#include <cmath>
#include <numbers>

namespace lenses {
std::vector<glm::dvec2> blank_of(const Lens& lens) {
  constexpr int kPoints = 360;
  std::vector<glm::dvec2> circle;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPoints;
    circle.push_back(0.5 * lens.diameter * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return circle;
}

bool inside_polygon(std::span<const glm::dvec2> polygon, const glm::dvec2& point) {
  bool in = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
      in = !in;
    }
  }
  return in;
}

std::vector<glm::dvec2> edge_of(const Lens& lens) {
  return lens.outline.empty() ? blank_of(lens) : lens.outline;
}

}  // namespace lenses
