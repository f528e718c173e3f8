#include "lenses/polygon.hpp"

#include <algorithm>

namespace lenses {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// Of two sides that properly cross: parallel ones do not.
std::optional<glm::dvec2> crossing(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  const glm::dvec2 ab = b - a, cd = d - c;
  const double area = cross(ab, cd);
  if (area == 0.0) return std::nullopt;
  const double s = cross(c - a, cd) / area, t = cross(c - a, ab) / area;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return std::nullopt;
  return a + s * ab;
}

}  // namespace

bool is_inside(std::span<const glm::dvec2> polygon, const glm::dvec2& point) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

std::optional<glm::dvec2> self_crossing(std::span<const glm::dvec2> polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % n];
    for (std::size_t k = i + 2; k < n; ++k) {
      if (i == 0 && k + 1 == n) continue;  // neighbours across the end
      const glm::dvec2 &c = polygon[k], &d = polygon[(k + 1) % n];
      if (std::max(c.x, d.x) < std::min(a.x, b.x) || std::min(c.x, d.x) > std::max(a.x, b.x)) continue;
      if (const auto at = crossing(a, b, c, d)) return at;
    }
  }
  return std::nullopt;
}

}  // namespace lenses
