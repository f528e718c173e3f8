#include "lenses/surface_forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace lenses {
namespace {

using f64::SurfaceData;

int to_int(std::size_t n) {
  return static_cast<int>(n);
}

// What stands for one surface without a segment, with what it keeps in the table appended there.
template <class Convert>
SurfaceData converted(const SurfaceData& s, std::vector<glm::dvec4>& table, const Convert& convert) {
  SurfaceData base = s;
  base.parts = glm::ivec4(0);
  SurfaceData out = convert(base, table);
  out.parts.w = 1 << out.kind.x | (out.shift.w != 0.0 ? 1 << f64::kPlaced : 0);
  if (s.parts.z > 0) {
    const SurfaceData segment = convert(f64::segment_surface(f64::Table{table}, s), table);
    out.parts.x = to_int(table.size());
    out.parts.y = s.parts.y;
    out.parts.z = s.parts.z;
    out.parts.w |= 1 << segment.kind.x | (segment.shift.w != 0.0 ? 1 << f64::kPlaced : 0) | 1 << f64::kSegmented;
    table.insert(table.end(), {segment.shape, segment.frame, segment.domain, glm::dvec4(segment.kind),
                               glm::dvec4(segment.offset), segment.shift, segment.slope});
  }
  return out;
}

template <class Convert>
LensModel all_converted(const LensModel& lenses, const Convert& convert) {
  LensModel out = lenses;
  for (f64::LensData& lens : out.lens) {
    if (lens.glass.w == 0.0) {
      continue;
    }
    const auto surface = [&](const SurfaceData& s, std::vector<glm::dvec4>& table) {
      return convert(s, lens.glass.z, table);
    };
    lens.back = converted(lens.back, out.table, surface);
    lens.front = converted(lens.front, out.table, surface);
  }
  return out;
}

SurfaceData meshed(const SurfaceData& s, int squares, double semi_diameter, std::vector<glm::dvec4>& table) {
  const double side = 2.0 * semi_diameter / squares;
  std::vector<glm::dvec4> vertices;
  glm::dvec2 heights(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
  for (int i = 0; i <= squares; ++i) {
    for (int j = 0; j <= squares; ++j) {
      const glm::dvec2 p(-semi_diameter + i * side, -semi_diameter + j * side);
      const f64::SurfacePoint point = f64::placed_point(f64::Table{table}, s, p);
      if (!point.inside) {
        vertices.emplace_back(0.0);
        continue;
      }
      vertices.emplace_back(point.z, point.gradient, 1.0);
      heights = {std::min(heights.x, point.z), std::max(heights.y, point.z)};
    }
  }
  SurfaceData mesh{};
  mesh.shape = glm::dvec4(-semi_diameter, -semi_diameter, 1.0 / side, side);
  mesh.frame = heights.x <= heights.y ? glm::dvec4(heights, 0.0, 0.0) : glm::dvec4(0.0);
  mesh.domain = glm::dvec4(-semi_diameter, semi_diameter, -semi_diameter, semi_diameter);
  mesh.kind = glm::ivec4(f64::kFacets, 0, squares, squares);
  mesh.offset.x = to_int(table.size());
  table.insert(table.end(), vertices.begin(), vertices.end());
  return mesh;
}

// A bicubic cell's control points from its power basis; rows by power of the second coordinate (cell_value).
std::array<double, 16> control_values(std::span<const glm::dvec4> rows) {
  // b_k = sum over i <= k of C(k, i) / C(3, i) a_i (Farin 2002).
  static constexpr double kTo[4][4] = {
      {1.0, 0.0, 0.0, 0.0}, {1.0, 1.0 / 3.0, 0.0, 0.0}, {1.0, 2.0 / 3.0, 1.0 / 3.0, 0.0}, {1.0, 1.0, 1.0, 1.0}};
  std::array<double, 16> control{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (glm::length_t a = 0; a < 4; ++a) {
        for (std::size_t b = 0; b < 4; ++b) {
          control[4 * i + j] += kTo[i][a] * kTo[j][b] * rows[b][a];
        }
      }
    }
  }
  return control;
}

using ControlPoints = std::array<glm::dvec3, 16>;  // that along v fastest

ControlPoints patch_of_cell(const SurfaceData& s, std::span<const glm::dvec4> table, int i, int j) {
  const bool parametric = s.kind.x == f64::kBsplineSurface;
  const auto first = static_cast<std::size_t>(s.offset.x + (parametric ? 12 : 4) * (i * s.kind.w + j));
  ControlPoints points{};
  if (parametric) {
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      const auto values = control_values(table.subspan(first + 4 * static_cast<std::size_t>(axis), 4));
      for (std::size_t k = 0; k < 16; ++k) {
        points[k][axis] = values[k];
      }
    }
  } else {
    const glm::dvec4& x = table[static_cast<std::size_t>(s.offset.y + i)];  // breaks: see find_cell
    const glm::dvec4& y = table[static_cast<std::size_t>(s.offset.z + j)];
    const auto values = control_values(table.subspan(first, 4));
    for (std::size_t k = 0; k < 16; ++k) {
      const auto along_u = static_cast<double>(k / 4) / 3.0;
      const auto along_v = static_cast<double>(k % 4) / 3.0;
      points[k] = {x.x + along_u * (x.z - x.x), y.x + along_v * (y.z - y.x), values[k]};
    }
  }
  if (s.shift.w != 0.0) {  // placing is linear: it moves the control points
    for (glm::dvec3& p : points) {
      p += glm::dvec3(s.shift.x, s.shift.y, s.shift.z);
      p.z += s.slope.x * p.x + s.slope.y * p.y;
    }
  }
  return points;
}

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

// A balanced tree: halves by the middles along the longer side. Appends the node, two entries, and returns its index.
class PatchTree {
 public:
  explicit PatchTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    std::vector<int> all(boxes_.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] = to_int(i);
    }
    build(all);
  }

  [[nodiscard]] const std::vector<glm::dvec4>& nodes() const { return nodes_; }

 private:
  [[nodiscard]] const Box& box(int i) const { return boxes_[static_cast<std::size_t>(i)]; }

  int build(std::span<int> patches) {
    Box around;
    for (const int i : patches) {
      around.low = glm::min(around.low, box(i).low);
      around.high = glm::max(around.high, box(i).high);
    }
    constexpr double kMargin = 1e-7;  // m: more than a float engine rounds
    const std::size_t at = nodes_.size();
    nodes_.emplace_back(around.low - kMargin, static_cast<double>(patches.front()));
    nodes_.emplace_back(around.high + kMargin, -1.0);
    if (patches.size() > 1) {
      const glm::dvec3 size = around.high - around.low;
      const glm::length_t axis = size.x >= size.y ? 0 : 1;
      const auto half = patches.begin() + static_cast<std::ptrdiff_t>(patches.size() / 2);
      std::ranges::nth_element(patches, half, {}, [&](int i) { return box(i).low[axis] + box(i).high[axis]; });
      const int first = build(patches.first(patches.size() / 2));
      const int second = build(patches.subspan(patches.size() / 2));
      nodes_[at].w = first;
      nodes_[at + 1].w = second;
    }
    return to_int(at / 2);
  }

  std::vector<Box> boxes_;
  std::vector<glm::dvec4> nodes_;
};

SurfaceData patched(const SurfaceData& s, std::vector<glm::dvec4>& table) {
  if (s.kind.x != f64::kBsplineHeightField && s.kind.x != f64::kEvenBspline && s.kind.x != f64::kBsplineSurface) {
    return s;
  }
  SurfaceData out{};
  std::vector<glm::dvec4> points;
  std::vector<Box> boxes;
  for (int i = 0; i < s.kind.z; ++i) {
    for (int j = 0; j < s.kind.w; ++j) {
      Box& box = boxes.emplace_back();
      for (const glm::dvec3& p : patch_of_cell(s, table, i, j)) {
        points.emplace_back(p, 0.0);
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
      }
    }
  }
  const PatchTree tree(std::move(boxes));
  out.kind = glm::ivec4(f64::kBezier, 0, to_int(tree.nodes().size() / 2), 0);
  out.offset.x = to_int(table.size());
  table.insert(table.end(), points.begin(), points.end());
  out.offset.y = to_int(table.size());
  table.insert(table.end(), tree.nodes().begin(), tree.nodes().end());
  return out;
}

}  // namespace

LensModel as_mesh(const LensModel& lenses, int facets) {
  // Two triangles a square, pi / 4 of the square on the disc.
  const int squares = static_cast<int>(std::lround(std::sqrt(2.0 * facets / std::numbers::pi)));
  return all_converted(lenses, [&](const SurfaceData& s, double semi_diameter, std::vector<glm::dvec4>& table) {
    return meshed(s, std::max(squares, 2), semi_diameter, table);
  });
}

LensModel as_bezier_patches(const LensModel& lenses) {
  return all_converted(lenses,
                       [](const SurfaceData& s, double, std::vector<glm::dvec4>& table) { return patched(s, table); });
}

}  // namespace lenses
