#include "app/measure/lens_marks.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "lenses/measure/readings.hpp"

namespace app {

std::vector<glm::dvec2> plotted(const std::vector<glm::dvec2>& polygon,
                                const std::function<glm::dvec2(const glm::dvec2&)>& to_plot) {
  const int parts = polygon.size() < 100 ? 16 : 1;
  std::vector<glm::dvec2> line;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    for (int k = 0; k < parts; ++k) {
      line.push_back(to_plot(a + (b - a) * (static_cast<double>(k) / parts)));
    }
  }
  return line;
}

void add_lens_marks(MapPicture& map, const lenses::Lens& lens, const ToPlot& to_plot) {
  const lenses::ReferencePoints& points = lens.reference_points;
  const auto add = [&](MapMark::Shape shape, const std::optional<glm::dvec2>& at, const char* label) {
    if (!at) {
      return;
    }
    const glm::dvec2 place = to_plot.from_back(*at);
    // Points that coincide share a label.
    const auto same = std::ranges::find_if(
        map.marks, [&](const MapMark& mark) { return !mark.label.empty() && glm::distance(mark.at, place) < 1e-6; });
    if (same != map.marks.end()) {
      same->label += std::string(" ") + label;
      map.marks.push_back({shape, place, ""});
    } else {
      map.marks.push_back({shape, place, label});
    }
  };
  add(MapMark::Shape::cross, points.fitting_cross, "");
  add(MapMark::Shape::circle, points.distance, "D");
  add(MapMark::Shape::circle, points.near, "N");
  add(MapMark::Shape::dot, lenses::prism_point(lens), "P");
  if (!lens.outline.empty()) {
    map.outlines.push_back(plotted(lens.outline, to_plot.from_back));
  }
  // Numbers as zone_of (lenses/measure/zone.hpp) gives them.
  if (const auto* segmented = std::get_if<lenses::SegmentedSurface>(&lens.back)) {
    map.zones.push_back({plotted(segmented->boundary, to_plot.from_back), 1});
  }
  if (const auto* segmented = std::get_if<lenses::SegmentedSurface>(&lens.front)) {
    map.zones.push_back({plotted(segmented->boundary, to_plot.from_front), 2});
  }
}

lenses::Lens without_segments(lenses::Lens lens) {
  for (lenses::Surface* surface : {&lens.front, &lens.back}) {
    if (const auto* segmented = std::get_if<lenses::SegmentedSurface>(surface)) {
      const lenses::BasicSurface base = segmented->base;
      *surface = std::visit([](const auto& shape) { return lenses::Surface(shape); }, base);
    }
  }
  return lens;
}

glm::dvec2 back_of_front_point(const lenses::Lensmeter& lensmeter, const glm::dvec2& point) {
  constexpr int kSteps = 12;
  glm::dvec2 back = point;
  for (int i = 0; i < kSteps; ++i) {
    const lenses::LensmeterReading reading = lensmeter.read(lenses::LensSide::back, back);
    if (reading.status != lenses::RayStatus::ok) {
      return point;
    }
    back += point - reading.far_point;
  }
  return back;
}

}  // namespace app
