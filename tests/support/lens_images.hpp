// A lens's images under the symmetries that its optics must respect: mirrored front to back, mirrored left to right,
// scaled.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "lenses/lens.hpp"

namespace support {

inline lenses::Placement flipped(const lenses::Placement& p) {
  return {p.decentration, -p.slope, -p.height};
}
inline lenses::Placement mirrored(const lenses::Placement& p) {
  const glm::dvec2 flip(-1.0, 1.0);
  return {flip * p.decentration, flip * p.slope, p.height};
}
inline lenses::Placement scaled(const lenses::Placement& p, double s) {
  return {s * p.decentration, p.slope, s * p.height};
}

// z -> -z. Surface is lenses::Surface or lenses::BasicSurface, here and below.
template <class Surface>
Surface flipped(const Surface& surface) {
  Surface out = surface;
  if (auto* sphere = std::get_if<lenses::Sphere>(&out)) {
    sphere->curvature = -sphere->curvature;
  } else if (auto* conic = std::get_if<lenses::Conic>(&out)) {
    conic->curvature = -conic->curvature;
    std::ranges::transform(conic->even_coefficients, conic->even_coefficients.begin(), std::negate<>());
  } else if (auto* torus = std::get_if<lenses::Torus>(&out)) {
    torus->curvature_u = -torus->curvature_u;
    torus->curvature_v = -torus->curvature_v;
  } else if (auto* heights = std::get_if<lenses::BsplineHeightField>(&out)) {
    std::ranges::transform(heights->control_z, heights->control_z.begin(), std::negate<>());
  } else if (auto* patch = std::get_if<lenses::BsplineSurface>(&out)) {
    std::ranges::for_each(patch->control, [](glm::dvec3& p) { p.z = -p.z; });
  }
  if constexpr (std::is_same_v<Surface, lenses::Surface>) {
    if (auto* parts = std::get_if<lenses::SegmentedSurface>(&out)) {
      *parts = {flipped(parts->base), flipped(parts->segment), flipped(parts->segment_placement), parts->boundary};
    }
  }
  return out;
}

inline std::vector<double> reversed_knots(const std::vector<double>& knots) {
  std::vector<double> out(knots.rbegin(), knots.rend());
  std::ranges::transform(out, out.begin(), std::negate<>());
  return out;
}

// Rows i in reverse order of a net of rows of `length`.
template <class T>
std::vector<T> reversed_rows(const std::vector<T>& net, std::size_t length) {
  std::vector<T> out;
  for (std::size_t end = net.size(); end > 0; end -= length) {
    const auto row = net.begin() + static_cast<std::ptrdiff_t>(end - length);
    out.insert(out.end(), row, row + static_cast<std::ptrdiff_t>(length));
  }
  return out;
}

// x -> -x.
template <class Surface>
Surface mirrored(const Surface& surface) {
  Surface out = surface;
  if (auto* torus = std::get_if<lenses::Torus>(&out)) {
    torus->axis = std::numbers::pi - torus->axis;
  } else if (auto* heights = std::get_if<lenses::BsplineHeightField>(&out)) {
    heights->control_z = reversed_rows(heights->control_z, heights->count_y());
    heights->knots_x = reversed_knots(heights->knots_x);
  } else if (auto* patch = std::get_if<lenses::BsplineSurface>(&out)) {
    patch->control = reversed_rows(patch->control, patch->count_v());
    patch->knots_u = reversed_knots(patch->knots_u);
    std::ranges::for_each(patch->control, [](glm::dvec3& p) { p.x = -p.x; });
  }
  if constexpr (std::is_same_v<Surface, lenses::Surface>) {
    if (auto* parts = std::get_if<lenses::SegmentedSurface>(&out)) {
      *parts = {mirrored(parts->base), mirrored(parts->segment), mirrored(parts->segment_placement), parts->boundary};
      std::ranges::for_each(parts->boundary, [](glm::dvec2& p) { p.x = -p.x; });
    }
  }
  return out;
}

// The same lens for the other eye.
inline lenses::Lens mirrored(const lenses::Lens& lens) {
  lenses::Lens out = lens;
  out.front = mirrored(lens.front);
  out.back = mirrored(lens.back);
  out.front_placement = mirrored(lens.front_placement);
  out.back_placement = mirrored(lens.back_placement);
  out.fit.decentration.x = -lens.fit.decentration.x;
  return out;
}

template <class Surface>
Surface scaled(const Surface& surface, double s) {
  Surface out = surface;
  if (auto* sphere = std::get_if<lenses::Sphere>(&out)) {
    sphere->curvature /= s;
  } else if (auto* conic = std::get_if<lenses::Conic>(&out)) {
    conic->curvature /= s;
    double power = s * s * s;
    for (double& a : conic->even_coefficients) {
      a /= power;
      power *= s * s;
    }
  } else if (auto* torus = std::get_if<lenses::Torus>(&out)) {
    torus->curvature_u /= s;
    torus->curvature_v /= s;
  } else if (auto* heights = std::get_if<lenses::BsplineHeightField>(&out)) {
    for (auto* values : {&heights->knots_x, &heights->knots_y, &heights->control_z}) {
      std::ranges::for_each(*values, [s](double& x) { x *= s; });
    }
  } else if (auto* patch = std::get_if<lenses::BsplineSurface>(&out)) {
    std::ranges::for_each(patch->control, [s](glm::dvec3& p) { p *= s; });
  }
  if constexpr (std::is_same_v<Surface, lenses::Surface>) {
    if (auto* parts = std::get_if<lenses::SegmentedSurface>(&out)) {
      *parts = {scaled(parts->base, s), scaled(parts->segment, s), scaled(parts->segment_placement, s),
                parts->boundary};
      std::ranges::for_each(parts->boundary, [s](glm::dvec2& p) { p *= s; });
    }
  }
  return out;
}

inline lenses::Lens scaled(const lenses::Lens& lens, double s) {
  lenses::Lens out = lens;
  out.front = scaled(lens.front, s);
  out.back = scaled(lens.back, s);
  out.front_placement = scaled(lens.front_placement, s);
  out.back_placement = scaled(lens.back_placement, s);
  out.centre_thickness *= s;
  out.diameter *= s;
  out.fit.vertex_distance *= s;
  out.fit.decentration *= s;
  return out;
}

}  // namespace support
