#include "lenses/surface_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lenses/bspline.hpp"

namespace lenses {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;  // clang before 17 does not deduce aggregates

int to_int(std::size_t n) {
  return static_cast<int>(n);
}

f64::SurfaceData conic_data(double curvature, double conic_constant, int kind) {
  f64::SurfaceData s{};
  s.shape = glm::dvec4(curvature, 0.0, conic_constant, 0.0);
  s.frame = glm::dvec4(1.0, 0.0, 0.0, curvature);
  s.kind.x = kind;
  return s;
}

f64::SurfaceData make_conic(const Conic& conic, double semi_diameter, std::vector<glm::dvec4>& table) {
  f64::SurfaceData s = conic_data(conic.curvature, conic.conic_constant, f64::kConic);
  s.shape.w = 1.0 / (semi_diameter * semi_diameter);
  s.kind.y = to_int(conic.even_coefficients.size());
  s.offset.x = to_int(table.size());
  double power = std::pow(semi_diameter, 4);
  for (const double a : conic.even_coefficients) {
    table.emplace_back(a * power, 0.0, 0.0, 0.0);
    power *= semi_diameter * semi_diameter;
  }
  return s;
}

f64::SurfaceData make_torus(const Torus& torus) {
  const bool turns_u = torus.revolve == Torus::Revolve::u;
  const double axis = turns_u ? torus.axis : torus.axis + 0.5 * std::numbers::pi;
  f64::SurfaceData s{};
  s.shape.x = turns_u ? torus.curvature_u : torus.curvature_v;
  s.shape.y = turns_u ? torus.curvature_v : torus.curvature_u;
  s.frame = glm::dvec4(std::cos(axis), std::sin(axis), 0.0, 0.5 * (torus.curvature_u + torus.curvature_v));
  s.kind.x = f64::kTorus;
  return s;
}

// The sphere that a spline looks like around the lens axis, for the first guess of an intersection.
void set_base_sphere(f64::SurfaceData& s, const std::vector<glm::dvec4>& table) {
  const glm::dvec2 at(std::clamp(0.0, s.domain.x, s.domain.y), std::clamp(0.0, s.domain.z, s.domain.w));
  const f64::SurfacePoint p = f64::surface_point(f64::Table{table}, s, at);
  s.frame = glm::dvec4(1.0, 0.0, p.z - 0.5 * dot(p.gradient, at), 0.5 * (p.hessian.x + p.hessian.z));
}

// Rounding of knots written in decimal; beyond it a point's place within its cell would be off.
constexpr double kEven = 1e-9;

bool is_even(const Cells& cells) {
  const double size = (cells.breaks.back() - cells.breaks.front()) / static_cast<double>(cells.count());
  for (std::size_t i = 0; i < cells.count(); ++i) {
    if (std::abs(cells.breaks[i] - cells.breaks.front() - static_cast<double>(i) * size) > kEven * size) return false;
  }
  return true;
}

f64::SurfaceData make_height_field(const BsplineHeightField& spline, std::vector<glm::dvec4>& table) {
  const Cells x = cells_of(spline.knots_x);
  const Cells y = cells_of(spline.knots_y);
  f64::SurfaceData s{};
  s.domain = glm::dvec4(x.breaks.front(), x.breaks.back(), y.breaks.front(), y.breaks.back());
  s.kind = glm::ivec4(f64::kBsplineHeightField, 0, to_int(x.count()), to_int(y.count()));
  s.offset.y = to_int(table.size());
  std::ranges::copy(break_table(x), std::back_inserter(table));
  s.offset.z = to_int(table.size());
  std::ranges::copy(break_table(y), std::back_inserter(table));
  s.offset.x = to_int(table.size());
  const std::size_t start = table.size();
  table.resize(start + 4 * x.count() * y.count());
  append_power_basis(spline.knots_x, spline.knots_y, spline.control_z, 4, std::span(table).subspan(start));
  if (is_even(x) && is_even(y)) {
    s.kind.x = f64::kEvenBspline;
    s.shape = glm::dvec4(s.domain.x, static_cast<double>(x.count()) / (s.domain.y - s.domain.x), s.domain.z,
                         static_cast<double>(y.count()) / (s.domain.w - s.domain.z));
  }
  set_base_sphere(s, table);
  return s;
}

// Start values of (u, v) for every square of the patch's bounding box: the sample that falls nearest to its middle.
void append_lookup(f64::SurfaceData& s, const Cells& u, const Cells& v, std::vector<glm::dvec4>& table) {
  struct Sample {
    glm::dvec2 uv, xy;
  };
  constexpr std::size_t kPerCell = 4;
  std::vector<Sample> samples;
  glm::dvec2 low(1e30);
  glm::dvec2 high(-1e30);
  for (std::size_t i = 0; i < u.count(); ++i) {
    for (std::size_t j = 0; j < v.count(); ++j) {
      for (std::size_t k = 0; k < (kPerCell + 1) * (kPerCell + 1); ++k) {
        const glm::dvec2 local(static_cast<double>(k % (kPerCell + 1)) / kPerCell,
                               static_cast<double>(k / (kPerCell + 1)) / kPerCell);
        const int at = s.offset.x + 12 * to_int(i * v.count() + j);
        const f64::CellValue x = f64::cell_value(f64::cell_at(f64::Table{table}, at), local.x, local.y);
        const f64::CellValue y = f64::cell_value(f64::cell_at(f64::Table{table}, at + 4), local.x, local.y);
        if (!(x.d.x * y.d.y - x.d.y * y.d.x > 0.0)) {
          throw std::invalid_argument("the patch folds over: d(x, y)/d(u, v) must be positive everywhere");
        }
        const glm::dvec2 xy(x.f, y.f);
        samples.push_back({{u.breaks[i] + local.x * (u.breaks[i + 1] - u.breaks[i]),
                            v.breaks[j] + local.y * (v.breaks[j + 1] - v.breaks[j])},
                           xy});
        low = glm::min(low, xy);
        high = glm::max(high, xy);
      }
    }
  }
  s.domain = glm::dvec4(low.x, high.x, low.y, high.y);
  constexpr int kSize = f64::kLookupSize;
  const glm::dvec2 step = (high - low) / static_cast<double>(kSize);
  const auto middle = [&](int ix, int iy) { return low + step * glm::dvec2(ix + 0.5, iy + 0.5); };
  const auto nearest = [](const std::vector<Sample>& from, const glm::dvec2& point) {
    return *std::ranges::min_element(from, {},
                                     [&](const Sample& sample) { return dot(sample.xy - point, sample.xy - point); });
  };
  std::vector<std::vector<Sample>> squares(static_cast<std::size_t>(kSize * kSize));
  for (const Sample& sample : samples) {
    const glm::ivec2 at = glm::clamp(glm::ivec2((sample.xy - low) / step), 0, kSize - 1);
    squares[static_cast<std::size_t>(at.x * kSize + at.y)].push_back(sample);
  }
  // The best of each square; a square that holds none takes the nearest of those.
  std::vector<Sample> best;
  for (int k = 0; k < kSize * kSize; ++k) {
    std::vector<Sample>& square = squares[static_cast<std::size_t>(k)];
    if (!square.empty()) {
      best.push_back(nearest(square, middle(k / kSize, k % kSize)));
      square = {best.back()};
    }
  }
  s.offset.w = to_int(table.size());
  for (int k = 0; k < kSize * kSize; ++k) {
    const std::vector<Sample>& square = squares[static_cast<std::size_t>(k)];
    table.emplace_back((square.empty() ? nearest(best, middle(k / kSize, k % kSize)) : square.front()).uv, 0.0, 0.0);
  }
}

f64::SurfaceData make_parametric(const BsplineSurface& spline, std::vector<glm::dvec4>& table) {
  const Cells u = cells_of(spline.knots_u);
  const Cells v = cells_of(spline.knots_v);
  f64::SurfaceData s{};
  s.kind = glm::ivec4(f64::kBsplineSurface, 0, to_int(u.count()), to_int(v.count()));
  s.offset.y = to_int(table.size());
  std::ranges::copy(break_table(u), std::back_inserter(table));
  s.offset.z = to_int(table.size());
  std::ranges::copy(break_table(v), std::back_inserter(table));
  s.offset.x = to_int(table.size());
  const std::size_t start = table.size();
  table.resize(start + 12 * u.count() * v.count());
  std::vector<double> component(spline.control.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(spline.control, component.begin(), [&](const glm::dvec3& p) { return p[axis]; });
    append_power_basis(spline.knots_u, spline.knots_v, component, 12,
                       std::span(table).subspan(start + 4 * static_cast<std::size_t>(axis)));
  }
  append_lookup(s, u, v, table);
  set_base_sphere(s, table);
  return s;
}

f64::SurfaceData make_shape(const BasicSurface& surface, double semi_diameter, std::vector<glm::dvec4>& table) {
  return std::visit(Overloaded{[&](const Plane&) { return conic_data(0.0, 0.0, f64::kPlane); },
                               [&](const Sphere& s) { return conic_data(s.curvature, 0.0, f64::kSphere); },
                               [&](const Conic& s) { return make_conic(s, semi_diameter, table); },
                               [&](const Torus& s) { return make_torus(s); },
                               [&](const BsplineHeightField& s) { return make_height_field(s, table); },
                               [&](const BsplineSurface& s) { return make_parametric(s, table); }},
                    surface);
}

f64::SurfaceData make_basic(const BasicSurface& surface, const Placement& placement, double semi_diameter,
                            std::vector<glm::dvec4>& table) {
  f64::SurfaceData s = make_shape(surface, semi_diameter, table);
  s.parts.w = 1 << s.kind.x;
  if (placement != Placement{}) {
    s.shift = glm::dvec4(placement.decentration, placement.height, 1.0);
    s.slope = glm::dvec4(placement.slope, 0.0, 0.0);
    s.parts.w |= 1 << f64::kPlaced;
  }
  return s;
}

// `inner`, given in axes that `outer` places, in the axes of `outer` itself.
Placement combined(const Placement& outer, const Placement& inner) {
  return {outer.decentration + inner.decentration, outer.slope + inner.slope, outer.height + inner.height};
}

// As in_segment (lenses/gpu/surface.h) reads them. A level edge is never asked for its dx/dy.
void append_boundary(const std::vector<glm::dvec2>& boundary, std::vector<glm::dvec4>& table) {
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const glm::dvec2& a = boundary[i];
    const glm::dvec2& b = boundary[(i + 1) % boundary.size()];
    const double inclination = (b.x - a.x) / (b.y - a.y);
    table.emplace_back(a.x, std::isfinite(inclination) ? inclination : 0.0, a.y, b.y);
  }
}

f64::SurfaceData make_segmented(const SegmentedSurface& surface, const Placement& placement, double semi_diameter,
                                std::vector<glm::dvec4>& table) {
  const f64::SurfaceData segment =
      make_basic(surface.segment, combined(placement, surface.segment_placement), semi_diameter, table);
  f64::SurfaceData s = make_basic(surface.base, placement, semi_diameter, table);
  s.parts.x = to_int(table.size());
  table.insert(table.end(), {segment.shape, segment.frame, segment.domain, glm::dvec4(segment.kind),
                             glm::dvec4(segment.offset), segment.shift, segment.slope});
  s.parts.y = to_int(table.size());
  append_boundary(surface.boundary, table);
  s.parts.z = to_int(surface.boundary.size());
  s.parts.w |= segment.parts.w | 1 << f64::kSegmented;
  return s;
}

}  // namespace

f64::SurfaceData make_surface(const Surface& surface, const Placement& placement, double semi_diameter,
                              std::vector<glm::dvec4>& table) {
  return std::visit(
      Overloaded{[&](const SegmentedSurface& s) { return make_segmented(s, placement, semi_diameter, table); },
                 [&](const auto& s) { return make_basic(s, placement, semi_diameter, table); }},
      surface);
}

}  // namespace lenses
