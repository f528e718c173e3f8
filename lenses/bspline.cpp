#include "lenses/bspline.hpp"

#include <stdexcept>

namespace lenses {

Cells cells_of(std::span<const double> knots) {
  Cells cells;
  const std::size_t count = knots.size() - 4;
  for (std::size_t i = 3; i < count; ++i) {
    if (knots[i + 1] > knots[i]) {
      cells.breaks.push_back(knots[i]);
      cells.first_control.push_back(i - 3);
    }
  }
  if (cells.first_control.empty()) {
    throw std::invalid_argument("the knots leave no interval with a surface on it");
  }
  cells.breaks.push_back(knots[count]);
  return cells;
}

std::array<std::array<double, 4>, 4> cell_basis(std::span<const double> knots, const Cells& cells, std::size_t cell) {
  // Cox - de Boor on polynomials: basis[b] of degree d on this interval, coefficients by powers of s.
  const std::size_t interval = cells.first_control[cell] + 3;
  const double start = knots[interval];
  const double width = knots[interval + 1] - start;
  std::array<std::array<double, 4>, 4> basis{};
  basis[0][0] = 1.0;  // degree 0: the only one alive; basis[k] below belongs to control first + 3 - degree + k
  for (std::size_t degree = 1; degree <= 3; ++degree) {
    std::array<std::array<double, 4>, 4> next{};
    for (std::size_t k = 0; k < degree; ++k) {
      // The function of degree - 1 starting at knot i spreads to the two of the next degree starting at i - 1 and i.
      const std::size_t i = interval + 1 + k - degree;
      const double low = knots[i];
      const double span = knots[i + degree] - low;
      if (!(span > 0.0)) {
        continue;
      }
      // Rising factor (x - low)/span and falling factor (low + span - x)/span as a + b s.
      const double rise_a = (start - low) / span;
      const double rise_b = width / span;
      for (std::size_t p = 0; p < 4; ++p) {
        const double c = basis[k][p];
        next[k + 1][p] += c * rise_a;
        next[k][p] += c * (1.0 - rise_a);
        if (p + 1 < 4) {
          next[k + 1][p + 1] += c * rise_b;
          next[k][p + 1] -= c * rise_b;
        }
      }
    }
    basis = next;
  }
  return basis;
}

std::vector<glm::dvec4> break_table(const Cells& cells) {
  std::vector<glm::dvec4> table;
  const double density = static_cast<double>(cells.count()) / (cells.breaks.back() - cells.breaks.front());
  for (std::size_t i = 0; i < cells.count(); ++i) {
    const double x = cells.breaks[i];
    const double next = cells.breaks[i + 1];
    table.emplace_back(x, 1.0 / (next - x), next, density);
  }
  return table;
}

void append_power_basis(std::span<const double> knots_u, std::span<const double> knots_v,
                        std::span<const double> control, std::size_t stride, std::span<glm::dvec4> out) {
  const Cells cells_u = cells_of(knots_u);
  const Cells cells_v = cells_of(knots_v);
  const std::size_t count_v = knots_v.size() - 4;
  for (std::size_t i = 0; i < cells_u.count(); ++i) {
    const auto basis_u = cell_basis(knots_u, cells_u, i);
    for (std::size_t j = 0; j < cells_v.count(); ++j) {
      const auto basis_v = cell_basis(knots_v, cells_v, j);
      const std::span<glm::dvec4> rows = out.subspan(stride * (i * cells_v.count() + j), 4);
      for (int q = 0; q < 4; ++q) {
        rows[static_cast<std::size_t>(q)] = glm::dvec4(0.0);
      }
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = 0; b < 4; ++b) {
          const double z = control[(cells_u.first_control[i] + a) * count_v + cells_v.first_control[j] + b];
          for (std::size_t q = 0; q < 4; ++q) {
            for (int p = 0; p < 4; ++p) {
              rows[q][p] += z * basis_u[a][static_cast<std::size_t>(p)] * basis_v[b][q];
            }
          }
        }
      }
    }
  }
}

}  // namespace lenses
