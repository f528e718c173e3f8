#include "lenses/lens_model.hpp"

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
        const f64::CellValue x = f64::cell_value(f64::Table{table}, at, local.x, local.y);
        const f64::CellValue y = f64::cell_value(f64::Table{table}, at + 4, local.x, local.y);
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

f64::SurfaceData make_surface(const Surface& surface, double semi_diameter, std::vector<glm::dvec4>& table) {
  return std::visit(Overloaded{[&](const Plane&) { return conic_data(0.0, 0.0, f64::kPlane); },
                               [&](const Sphere& s) { return conic_data(s.curvature, 0.0, f64::kSphere); },
                               [&](const Conic& s) { return make_conic(s, semi_diameter, table); },
                               [&](const Torus& s) { return make_torus(s); },
                               [&](const BsplineHeightField& s) { return make_height_field(s, table); },
                               [&](const BsplineSurface& s) { return make_parametric(s, table); },
                               [](const SegmentedSurface&) -> f64::SurfaceData {
                                 throw std::invalid_argument("segmented surfaces are not traced");
                               }},
                    surface);
}

// Right eye Ry(-wrap) Rx(-panto), left eye Ry(+wrap) Rx(-panto): a positive wrap brings the temporal edge closer.
glm::dmat3 eye_from_lens_rotation(const Fit& fit, Side side) {
  const double w = side == Side::right ? -fit.wrap : fit.wrap;
  const double p = -fit.pantoscopic_tilt;
  const glm::dmat3 about_y({std::cos(w), 0.0, -std::sin(w)}, {0.0, 1.0, 0.0}, {std::sin(w), 0.0, std::cos(w)});
  const glm::dmat3 about_x({1.0, 0.0, 0.0}, {0.0, std::cos(p), std::sin(p)}, {0.0, -std::sin(p), std::cos(p)});
  return about_y * about_x;
}

glm::dmat2 cylinder_form(double along, double across, double axis) {
  const glm::dvec2 a(std::cos(axis), std::sin(axis));
  const glm::dvec2 b(-a.y, a.x);
  return along * glm::outerProduct(a, a) + across * glm::outerProduct(b, b);
}

// The excess power E - I/l of the relaxed eye at the pupil, in the axes of the wearer.
glm::dmat2 relaxed_excess(const Eye& eye) {
  if (eye.zernike) {
    // Thibos et al. 2002: the correcting lens's power vector from the second-order coefficients.
    const double r2 = 0.25 * eye.zernike->pupil_diameter * eye.zernike->pupil_diameter;
    const auto coefficient = [&](std::size_t j) {
      return j < eye.zernike->coefficients.size() ? eye.zernike->coefficients[j] : 0.0;
    };
    const double m = -4.0 * std::sqrt(3.0) * coefficient(4) / r2;
    const double j0 = -2.0 * std::sqrt(6.0) * coefficient(5) / r2;
    const double j45 = -2.0 * std::sqrt(6.0) * coefficient(3) / r2;
    return glm::dmat2(-(m + j0), j45, j45, -(m - j0));  // the examiner's x mirrored
  }
  if (const auto* relaxed = std::get_if<RelaxedPower>(&eye.power)) {
    return cylinder_form(relaxed->q1, relaxed->q2, relaxed->axis) - glm::dmat2(1.0 / eye.axial_length);
  }
  if (const auto* refraction = std::get_if<Refraction>(&eye.power)) {
    const glm::dmat2 f = cylinder_form(refraction->sphere, refraction->sphere + refraction->cylinder,
                                       std::numbers::pi - refraction->axis);
    const double d = eye.refraction_vertex + eye.entrance_pupil_depth;
    return -(f * glm::inverse(glm::dmat2(1.0) - d * f));
  }
  return glm::dmat2(0.0);
}

template <class To, class From>
void round_surface(To& to, const From& from) {
  to.shape = glm::vec4(from.shape);
  to.frame = glm::vec4(from.frame);
  to.domain = glm::vec4(from.domain);
  to.kind = from.kind;
  to.offset = from.offset;
}

}  // namespace

std::size_t append_lens(LensModel& model, const Lens* lens, Side side, double entrance_pupil_depth) {
  f64::LensData data{};
  if (lens != nullptr) {
    const glm::dmat3 rotation = eye_from_lens_rotation(lens->fit, side);
    const double semi_diameter = 0.5 * lens->diameter;
    data.axis_x = glm::dvec4(rotation[0], lens->fit.decentration.x);
    data.axis_y = glm::dvec4(rotation[1], lens->fit.decentration.y);
    data.axis_z = glm::dvec4(rotation[2], -(lens->fit.vertex_distance + entrance_pupil_depth));
    data.glass = glm::dvec4(lens->index, lens->centre_thickness, semi_diameter, 1.0);
    data.mount.x = lens->attached_to == Lens::AttachedTo::eye ? 1 : 0;
    data.back = make_surface(lens->back, semi_diameter, model.table);
    data.front = make_surface(lens->front, semi_diameter, model.table);
  }
  model.lens.push_back(data);
  return model.lens.size() - 1;
}

f64::EyeData make_eye_data(const Eye& eye, double accommodation_amplitude, double pupil_diameter) {
  const glm::dmat2 e = relaxed_excess(eye);
  f64::EyeData data{};
  data.excess = glm::dvec4(e[0][0], e[0][1], e[1][1], accommodation_amplitude);
  data.pupil = glm::dvec4(pupil_diameter, eye.centre_of_rotation_depth - eye.entrance_pupil_depth, 0.0, 0.0);
  return data;
}

f32::LensData to_float(const f64::LensData& lens) {
  f32::LensData out{};
  out.axis_x = glm::vec4(lens.axis_x);
  out.axis_y = glm::vec4(lens.axis_y);
  out.axis_z = glm::vec4(lens.axis_z);
  out.glass = glm::vec4(lens.glass);
  out.mount = lens.mount;
  round_surface(out.back, lens.back);
  round_surface(out.front, lens.front);
  return out;
}

f32::EyeData to_float(const f64::EyeData& eye) {
  f32::EyeData out{};
  out.excess = glm::vec4(eye.excess);
  out.pupil = glm::vec4(eye.pupil);
  return out;
}

std::vector<glm::vec4> to_float(const std::vector<glm::dvec4>& table) {
  return {table.begin(), table.end()};
}

}  // namespace lenses
