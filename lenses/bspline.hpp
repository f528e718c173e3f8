// Bicubic B-splines over arbitrary knots, on the host in double: basis functions (Cox - de Boor) and the change to
// per-cell power-basis coefficients that the tracers read.
#pragma once

#include <array>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace lenses {

// The distinct knots inside [knots[3], knots[n]], n = knots.size() - 4: cell k runs from breaks[k] to breaks[k + 1].
struct Cells {
  std::vector<double> breaks;
  std::vector<std::size_t> first_control;  // one a cell: the first of its four control points
  [[nodiscard]] std::size_t count() const { return first_control.size(); }
};

[[nodiscard]] Cells cells_of(std::span<const double> knots);

// The four cubic basis functions that live on a cell, as polynomials of the local coordinate s in [0, 1]:
// result[b][k] multiplies s^k.
[[nodiscard]] std::array<std::array<double, 4>, 4> cell_basis(std::span<const double> knots, const Cells& cells,
                                                              std::size_t cell);

// Breaks as find_cell (lenses/gpu/surface.h) reads them.
[[nodiscard]] std::vector<glm::dvec4> break_table(const Cells& cells);

// Four rows (by power of the second coordinate) of power-basis coefficients for every cell, cell (i, j) at
// stride * (i * cells_v + j); control[i * count_v + j], i along u.
void append_power_basis(std::span<const double> knots_u, std::span<const double> knots_v,
                        std::span<const double> control, std::size_t stride, std::span<glm::dvec4> out);

}  // namespace lenses
