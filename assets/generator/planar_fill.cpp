#include "assets/generator/planar_fill.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace assets {
namespace {

struct Edge {
  glm::dvec2 low, high;  // low.y < high.y
  int winding;

  // Exact at both ends, so that neighbouring trapezoids share their corners.
  [[nodiscard]] double x(double y) const {
    if (y <= low.y) return low.x;
    if (y >= high.y) return high.x;
    return low.x + (high.x - low.x) * (y - low.y) / (high.y - low.y);
  }
};

using Span = std::pair<std::size_t, std::size_t>;  // left and right edge

std::vector<Edge> edges_of(std::span<const Contour> contours) {
  std::vector<Edge> edges;
  for (const Contour& contour : contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const glm::dvec2 a = contour[i], b = contour[(i + 1) % contour.size()];
      if (a.y < b.y) edges.push_back({a, b, 1});
      if (a.y > b.y) edges.push_back({b, a, -1});
    }
  }
  return edges;
}

std::optional<double> crossing_height(const Edge& a, const Edge& b) {
  const double low = std::max(a.low.y, b.low.y), high = std::min(a.high.y, b.high.y);
  if (low >= high) return std::nullopt;
  const double before = a.x(low) - b.x(low), after = a.x(high) - b.x(high);
  if (before * after >= 0.0) return std::nullopt;
  return low + (high - low) * before / (before - after);
}

std::vector<double> slab_heights(std::span<const Edge> edges) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    heights.insert(heights.end(), {edges[i].low.y, edges[i].high.y});
    for (std::size_t j = 0; j < i; ++j) {
      if (const auto height = crossing_height(edges[i], edges[j])) heights.push_back(*height);
    }
  }
  std::sort(heights.begin(), heights.end());
  // Heights closer than a millionth of the shape are one corner rounded twice.
  const double least = heights.empty() ? 0.0 : 1e-6 * (heights.back() - heights.front());
  std::vector<double> distinct;
  for (const double height : heights) {
    if (distinct.empty() || height - distinct.back() > least) distinct.push_back(height);
  }
  return distinct;
}

std::vector<Span> spans_in(std::span<const Edge> edges, double low, double high) {
  const double middle = 0.5 * (low + high);
  std::vector<std::size_t> active;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].low.y < middle && edges[i].high.y > middle) active.push_back(i);
  }
  std::sort(active.begin(), active.end(),
            [&](std::size_t a, std::size_t b) { return edges[a].x(middle) < edges[b].x(middle); });
  std::vector<Span> spans;
  int winding = 0;
  std::size_t left = 0;
  for (const std::size_t i : active) {
    if (winding == 0) left = i;
    winding += edges[i].winding;
    if (winding == 0) spans.emplace_back(left, i);
  }
  return spans;
}

void add_trapezoid(FlatShape& shape, const Edge& left, const Edge& right, double low, double high) {
  const double width_low = right.x(low) - left.x(low), width_high = right.x(high) - left.x(high);
  const double least = 1e-9 * std::max(width_low, width_high);
  const auto first = static_cast<std::uint32_t>(shape.points.size());
  shape.points.emplace_back(left.x(low), low);
  if (width_low > least) shape.points.emplace_back(right.x(low), low);
  shape.points.emplace_back(right.x(high), high);
  if (width_high > least) shape.points.emplace_back(left.x(high), high);
  const auto count = static_cast<std::uint32_t>(shape.points.size()) - first;
  for (std::uint32_t i = 2; i < count; ++i)
    shape.indices.insert(shape.indices.end(), {first, first + i - 1, first + i});
}

}  // namespace

FlatShape fill(std::span<const Contour> contours) {
  const std::vector<Edge> edges = edges_of(contours);
  const std::vector<double> heights = slab_heights(edges);
  FlatShape shape;
  std::map<Span, double> open;  // spans that began at a lower slab, with the height where they began
  for (std::size_t slab = 0; slab + 1 < heights.size(); ++slab) {
    std::map<Span, double> next;
    for (const Span& span : spans_in(edges, heights[slab], heights[slab + 1])) {
      const auto begun = open.find(span);
      next[span] = begun == open.end() ? heights[slab] : begun->second;
    }
    for (const auto& [span, low] : open) {
      if (!next.contains(span)) add_trapezoid(shape, edges[span.first], edges[span.second], low, heights[slab]);
    }
    open = std::move(next);
  }
  for (const auto& [span, low] : open) {
    add_trapezoid(shape, edges[span.first], edges[span.second], low, heights.back());
  }
  return shape;
}

}  // namespace assets
