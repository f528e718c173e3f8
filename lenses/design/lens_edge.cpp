#include "lenses/design/lens_edge.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lenses::design {
namespace {

constexpr int kRoundPoints = 180;
constexpr double kSpacing = 1e-3;      // m, along a straight side
constexpr double kMostAround = 720.0;  // points on the sides of any outline, its corners not counted
constexpr int kRings = 10;

}  // namespace

std::vector<glm::dvec2> edge_points(const std::vector<glm::dvec2>& outline, double diameter) {
  std::vector<glm::dvec2> points;
  if (outline.empty()) {
    for (int i = 0; i < kRoundPoints; ++i) {
      const double a = 2.0 * std::numbers::pi * i / kRoundPoints;
      points.push_back(0.5 * diameter * glm::dvec2(std::cos(a), std::sin(a)));
    }
    return points;
  }
  double around = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    around += length(outline[(i + 1) % outline.size()] - outline[i]);
  }
  const double spacing = std::max(kSpacing, around / kMostAround);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 from = outline[i];
    const glm::dvec2 side = outline[(i + 1) % outline.size()] - from;
    const int parts = std::max(static_cast<int>(std::ceil(length(side) / spacing)), 1);
    for (int k = 0; k < parts; ++k) {
      points.push_back(from + side * (static_cast<double>(k) / parts));
    }
  }
  return points;
}

std::optional<ThicknessRange> thickness_range(const LensShape& lens, const std::vector<glm::dvec2>& edge) {
  const auto centre = lens.thickness({0.0, 0.0});
  if (!centre) {
    return std::nullopt;
  }
  ThicknessRange range{1e9, -1e9, *centre};
  for (const glm::dvec2& point : edge) {
    for (int ring = 1; ring <= kRings; ++ring) {
      const auto here = lens.thickness(point * (static_cast<double>(ring) / kRings));
      if (!here) {
        return std::nullopt;
      }
      range.thinnest = std::min(range.thinnest, *here);
      if (ring == kRings) {
        range.thinnest_edge = std::min(range.thinnest_edge, *here);
        range.thickest_edge = std::max(range.thickest_edge, *here);
      }
    }
  }
  return range;
}

double volume(const LensShape& lens, const std::vector<glm::dvec2>& edge) {
  double sum = 0.0;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const glm::dvec2 &a = edge[i], &b = edge[(i + 1) % edge.size()];
    const double area = 0.5 * (a.x * b.y - a.y * b.x);  // of the triangle with the centre
    for (int ring = 0; ring < kRings; ++ring) {
      // The middle of a ring of the triangle, whose share of the area grows with its radius.
      const double s = (ring + 0.5) / kRings;
      sum += area * (2.0 * s / kRings) * lens.thickness(s * 0.5 * (a + b)).value_or(0.0);
    }
  }
  return std::abs(sum);
}

}  // namespace lenses::design
