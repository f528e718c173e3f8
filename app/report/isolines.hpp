// Lines of equal value over a grid, by marching squares.
#pragma once

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

// Bilinear within a zone; where corners of the cell are missing or belong to another zone, the nearest of those that
// have a value. Not a number outside the grid or far from any value.
[[nodiscard]] double value_at(const GridField& field, const glm::dvec2& point);

struct Isoline {
  std::vector<glm::dvec2> points;  // closed: the first again at the end
};

// Cells flatter than `flat` have no lines: there a line would follow rounding.
[[nodiscard]] std::vector<Isoline> isolines(const GridField& field, double level, double flat = 1e-6);

}  // namespace app
