#include "app/report/isolines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iterator>
#include <limits>
#include <unordered_map>

namespace app {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// An end of a piece lies on an edge of the grid: 2 index for the edge to the right of a sample, 2 index + 1 for the one
// above it.
struct Piece {
  std::size_t from, to;
  bool real;  // more than a ripple
};

struct Pieces {
  std::vector<Piece> list;
  std::unordered_map<std::size_t, glm::dvec2> place;  // of an edge's crossing
};

struct Cell {
  std::array<std::size_t, 4> corner;  // lower left, lower right, upper right, upper left
  std::array<std::size_t, 4> edge;    // below, right, above, left
};

Cell cell_at(const lenses::Grid& grid, std::size_t column, std::size_t row) {
  const std::size_t at = row * grid.columns + column, above = at + grid.columns;
  return {{at, at + 1, above + 1, above}, {2 * at, 2 * (at + 1) + 1, 2 * above, 2 * at + 1}};
}

bool whole(const GridField& field, const Cell& cell) {
  return std::ranges::all_of(cell.corner, [&](std::size_t i) {
    return std::isfinite(field.values[i]) && field.zone(i) == field.zone(cell.corner[0]);
  });
}

bool crossed(const GridField& field, const Cell& cell, double level) {
  const auto above = std::ranges::count_if(cell.corner, [&](std::size_t i) { return field.values[i] >= level; });
  return above > 0 && above < 4;
}

// Calls f with the index of every sample within `reach` of one.
template <class F>
void around(const lenses::Grid& grid, std::size_t index, std::size_t reach, const F& f) {
  const std::size_t column = index % grid.columns, row = index / grid.columns;
  for (std::size_t r = row - std::min(row, reach); r <= std::min(row + reach, grid.rows - 1); ++r) {
    for (std::size_t c = column - std::min(column, reach); c <= std::min(column + reach, grid.columns - 1); ++c) {
      f(r * grid.columns + c);
    }
  }
}

bool more_than_a_ripple(const GridField& field, const Cell& cell, double level, double ripple) {
  const std::size_t reach = std::max<std::size_t>(2, field.grid.columns / 16);
  bool above = false, below = false;
  around(field.grid, cell.corner[0], reach, [&](std::size_t i) {
    if (field.zone(i) == field.zone(cell.corner[0])) {
      above = above || field.values[i] > level + ripple;
      below = below || field.values[i] < level - ripple;
    }
  });
  return above && below;
}

void add_pieces(const GridField& field, const Cell& cell, double level, bool real, Pieces& pieces) {
  std::vector<std::size_t> ends;  // in order around the cell
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t a = cell.corner[k], b = cell.corner[(k + 1) % 4];
    const double va = field.values[a], vb = field.values[b];
    if ((va >= level) == (vb >= level)) {
      continue;
    }
    const double part = (level - va) / (vb - va);
    pieces.place[cell.edge[k]] = field.grid.at(a) + part * (field.grid.at(b) - field.grid.at(a));
    ends.push_back(cell.edge[k]);
  }
  if (ends.size() == 2) {
    pieces.list.push_back({ends[0], ends[1], real});
  } else if (ends.size() == 4) {
    // A saddle: its middle says which corners are joined.
    double mean = 0.0;
    for (const std::size_t i : cell.corner) {
      mean += 0.25 * field.values[i];
    }
    const bool joins_first = (mean >= level) == (field.values[cell.corner[0]] >= level);
    const std::size_t shift = joins_first ? 0 : 1;
    pieces.list.push_back({ends[shift], ends[shift + 1], real});
    pieces.list.push_back({ends[shift + 2], ends[(shift + 3) % 4], real});
  }
}

std::vector<Isoline> joined(const Pieces& pieces) {
  std::unordered_multimap<std::size_t, std::size_t> at_edge;
  for (std::size_t i = 0; i < pieces.list.size(); ++i) {
    at_edge.emplace(pieces.list[i].from, i);
    at_edge.emplace(pieces.list[i].to, i);
  }
  std::vector<bool> used(pieces.list.size(), false);
  // A piece at an edge that is in no line yet.
  const auto next = [&](std::size_t edge) -> const Piece* {
    const auto [first, last] = at_edge.equal_range(edge);
    const auto found = std::find_if(first, last, [&](const auto& entry) { return !used[entry.second]; });
    if (found == last) {
      return nullptr;
    }
    used[found->second] = true;
    return &pieces.list[found->second];
  };
  std::vector<Isoline> lines;
  for (std::size_t i = 0; i < pieces.list.size(); ++i) {
    if (used[i]) {
      continue;
    }
    used[i] = true;
    std::deque<std::size_t> edges{pieces.list[i].from, pieces.list[i].to};
    std::size_t real = pieces.list[i].real ? 1 : 0;
    while (const Piece* piece = next(edges.back())) {
      real += piece->real ? 1U : 0U;
      edges.push_back(piece->from == edges.back() ? piece->to : piece->from);
    }
    while (const Piece* piece = next(edges.front())) {
      real += piece->real ? 1U : 0U;
      edges.push_front(piece->from == edges.front() ? piece->to : piece->from);
    }
    if (2 * real < edges.size() - 1) {
      continue;
    }
    Isoline line;
    std::ranges::transform(edges, std::back_inserter(line.points),
                           [&](std::size_t edge) { return pieces.place.at(edge); });
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

double value_at(const GridField& field, const glm::dvec2& point, const ZoneAt& zone_at) {
  const lenses::Grid& grid = field.grid;
  const glm::dvec2 place = (point - grid.low) / grid.step();
  const double columns = static_cast<double>(grid.columns - 1), rows = static_cast<double>(grid.rows - 1);
  if (!(place.x >= 0.0 && place.x <= columns && place.y >= 0.0 && place.y <= rows)) {
    return kNone;
  }
  const double column = std::min(std::floor(place.x), columns - 1.0), row = std::min(std::floor(place.y), rows - 1.0);
  const double fx = place.x - column, fy = place.y - row;
  const Cell cell = cell_at(grid, static_cast<std::size_t>(column), static_cast<std::size_t>(row));
  const std::array<double, 4> weight{(1 - fx) * (1 - fy), fx * (1 - fy), fx * fy, (1 - fx) * fy};
  const bool mixed =
      std::ranges::any_of(cell.corner, [&](std::size_t i) { return field.zone(i) != field.zone(cell.corner[0]); });
  const int zone = mixed && zone_at ? zone_at(point) : field.zone(cell.corner[0]);
  double sum = 0.0, total = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double value = field.values[cell.corner[k]];
    if (std::isfinite(value) && field.zone(cell.corner[k]) == zone) {
      constexpr double kLeast = 1e-9;  // so that a corner alone counts, however far
      sum += (weight[k] + kLeast) * value;
      total += weight[k] + kLeast;
    }
  }
  return total > 0.0 ? sum / total : kNone;
}

GridField grown(GridField field, int passes) {
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<double> before = field.values;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (std::isfinite(before[i])) {
        continue;
      }
      double sum = 0.0, count = 0.0;
      around(field.grid, i, 1, [&](std::size_t k) {
        if (std::isfinite(before[k]) && field.zone(k) == field.zone(i)) {
          sum += before[k];
          count += 1.0;
        }
      });
      field.values[i] = count > 0.0 ? sum / count : before[i];
    }
  }
  return field;
}

std::vector<Isoline> isolines(const GridField& field, double level, double ripple) {
  Pieces pieces;
  for (std::size_t row = 0; row + 1 < field.grid.rows; ++row) {
    for (std::size_t column = 0; column + 1 < field.grid.columns; ++column) {
      const Cell cell = cell_at(field.grid, column, row);
      if (whole(field, cell) && crossed(field, cell, level)) {
        add_pieces(field, cell, level, more_than_a_ripple(field, cell, level, ripple), pieces);
      }
    }
  }
  return joined(pieces);
}

}  // namespace app
