#include "app/report/isolines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <unordered_map>

namespace app {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// An end of a piece lies on an edge of the grid: 2 index for the edge to the right of a sample, 2 index + 1 for the one
// above it.
struct Piece {
  std::size_t from, to;
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

bool usable(const GridField& field, const Cell& cell, double flat) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::size_t i : cell.corner) {
    if (!std::isfinite(field.values[i]) || field.zone(i) != field.zone(cell.corner[0])) {
      return false;
    }
    low = std::min(low, field.values[i]);
    high = std::max(high, field.values[i]);
  }
  return high - low > flat;
}

void add_pieces(const GridField& field, const Cell& cell, double level, Pieces& pieces) {
  std::vector<std::size_t> crossed;  // in order around the cell
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t a = cell.corner[k], b = cell.corner[(k + 1) % 4];
    const double va = field.values[a], vb = field.values[b];
    if ((va >= level) == (vb >= level)) {
      continue;
    }
    const double part = (level - va) / (vb - va);
    pieces.place[cell.edge[k]] = field.grid.at(a) + part * (field.grid.at(b) - field.grid.at(a));
    crossed.push_back(cell.edge[k]);
  }
  if (crossed.size() == 2) {
    pieces.list.push_back({crossed[0], crossed[1]});
  } else if (crossed.size() == 4) {
    // A saddle: its middle says which corners are joined.
    double mean = 0.0;
    for (const std::size_t i : cell.corner) {
      mean += 0.25 * field.values[i];
    }
    const bool joins_first = (mean >= level) == (field.values[cell.corner[0]] >= level);
    const std::size_t shift = joins_first ? 0 : 1;
    pieces.list.push_back({crossed[shift], crossed[shift + 1]});
    pieces.list.push_back({crossed[shift + 2], crossed[(shift + 3) % 4]});
  }
}

std::vector<Isoline> joined(const Pieces& pieces) {
  std::unordered_multimap<std::size_t, std::size_t> at_edge;
  for (std::size_t i = 0; i < pieces.list.size(); ++i) {
    at_edge.emplace(pieces.list[i].from, i);
    at_edge.emplace(pieces.list[i].to, i);
  }
  std::vector<bool> used(pieces.list.size(), false);
  // The edge at the other end of an unused piece, if there is one.
  const auto next = [&](std::size_t edge, std::size_t& to) {
    const auto [first, last] = at_edge.equal_range(edge);
    for (auto it = first; it != last; ++it) {
      if (!used[it->second]) {
        used[it->second] = true;
        const Piece& piece = pieces.list[it->second];
        to = piece.from == edge ? piece.to : piece.from;
        return true;
      }
    }
    return false;
  };
  std::vector<Isoline> lines;
  for (std::size_t i = 0; i < pieces.list.size(); ++i) {
    if (used[i]) {
      continue;
    }
    used[i] = true;
    std::deque<std::size_t> edges{pieces.list[i].from, pieces.list[i].to};
    std::size_t to = 0;
    while (next(edges.back(), to)) {
      edges.push_back(to);
    }
    while (next(edges.front(), to)) {
      edges.push_front(to);
    }
    Isoline line;
    for (const std::size_t edge : edges) {
      line.points.push_back(pieces.place.at(edge));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

double value_at(const GridField& field, const glm::dvec2& point) {
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
  double sum = 0.0, heaviest = -1.0, nearest = kNone;
  bool whole = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const double value = field.values[cell.corner[k]];
    whole = whole && std::isfinite(value) && field.zone(cell.corner[k]) == field.zone(cell.corner[0]);
    sum += weight[k] * value;
    if (std::isfinite(value) && weight[k] > heaviest) {
      heaviest = weight[k];
      nearest = value;
    }
  }
  return whole ? sum : nearest;
}

std::vector<Isoline> isolines(const GridField& field, double level, double flat) {
  Pieces pieces;
  for (std::size_t row = 0; row + 1 < field.grid.rows; ++row) {
    for (std::size_t column = 0; column + 1 < field.grid.columns; ++column) {
      const Cell cell = cell_at(field.grid, column, row);
      if (usable(field, cell, flat)) {
        add_pieces(field, cell, level, pieces);
      }
    }
  }
  return joined(pieces);
}

}  // namespace app
