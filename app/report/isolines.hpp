// Lines of equal value over a grid, by marching squares.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "lenses/measure/grid.hpp"

namespace app {

// Values in the grid's order; not a number where there is none. Between zones the field jumps: no line is drawn, and
// nothing interpolated, across from one to another.
struct GridField {
  lenses::Grid grid;
  std::vector<double> values;
  std::vector<int> zones;  // empty: all one

  [[nodiscard]] int zone(std::size_t i) const { return zones.empty() ? 0 : zones[i]; }
};

// Which zone a point belongs to; asked only in cells whose corners belong to several.
using ZoneAt = std::function<int(const glm::dvec2&)>;

// Bilinear between corners of the point's own zone; where some are missing, their weights go to the others. Not a
// number outside the grid or where no corner has a value.
[[nodiscard]] double value_at(const GridField& field, const glm::dvec2& point, const ZoneAt& zone_at = {});

// The field with samples that have no value, but stand beside some that have, filled by those' mean; `passes` samples
// deep. For colours only: it makes rims whole that fall between samples.
[[nodiscard]] GridField grown(GridField field, int passes);

struct Isoline {
  std::vector<glm::dvec2> points;  // closed: the first again at the end
};

// No line along most of which the field, within a sixteenth of the grid, does not go beyond the level by more than
// `ripple` to both sides: it would follow ripples and rounding.
[[nodiscard]] std::vector<Isoline> isolines(const GridField& field, double level, double ripple);

}  // namespace app
