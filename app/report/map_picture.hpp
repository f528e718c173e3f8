// A map of one quantity as a picture: filled colours, isolines with their values, marks and outlines over them, axes
// with equal scales, a colour bar.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/report/isolines.hpp"
#include "app/report/map_scale.hpp"
#include "render/image/image.hpp"

namespace app {

struct MapMark {
  enum class Shape { cross, circle, dot };
  Shape shape = Shape::circle;
  glm::dvec2 at{0.0};
  std::string label;
};

// A part of the map in which other values hold than beside it: the edge of a segment.
struct MapZone {
  std::vector<glm::dvec2> edge;  // a closed polygon
  int number = 0;                // the zones of the samples inside; those of overlapping zones add
};

// A short line through a point, such as a cylinder's axis.
struct MapStroke {
  glm::dvec2 at{0.0};
  double angle = 0.0;  // counter-clockwise from +x, radians
};

struct MapPicture {
  std::string title, note;  // the note stands under the title
  std::string unit;
  int decimals = 2;  // of the isolines' values
  std::string x_label, y_label;
  std::string left, right;  // what lies to both sides, such as nose and temple
  // Not mirrored +x is to the right: positions as the wearer sees them. Mirrored, as the examiner does.
  bool mirrored = false;
  GridField field;
  MapScale scale;
  std::vector<glm::dvec2> region;                 // a polygon; colours fill no more
  std::vector<std::vector<glm::dvec2>> outlines;  // closed polygons
  std::vector<MapZone> zones;
  std::vector<MapMark> marks;
  std::vector<MapStroke> strokes;
};

[[nodiscard]] render::Image8 draw_map(const MapPicture& map);

}  // namespace app
