#include "lenses/measure/lensmeter.hpp"

#include <cmath>

#include "lenses/measure/zone.hpp"

namespace lenses {
namespace {

// Off the surface on the stop, so that it is the first the ray meets; well below any radius a lens can have.
constexpr double kStandOff = 1e-4;  // m

// Of a height field, towards the scene (-z), unit.
glm::dvec3 outward_normal(const f64::SurfacePoint& point) {
  return glm::normalize(glm::dvec3(point.gradient, -1.0));
}

struct Across {
  glm::dvec3 h, v;
};

Across across(const glm::dvec3& beam) {
  const glm::dvec3 h = f64::pupil_basis_h(beam);
  return {h, cross(h, beam)};
}

// Where a direction leaves a plane at unit distance along the beam, prism dioptres.
glm::dvec2 prism_dioptres(const glm::dvec3& direction, const glm::dvec3& beam, const Across& axes) {
  return 100.0 / dot(direction, beam) * glm::dvec2(dot(direction, axes.h), dot(direction, axes.v));
}

glm::dvec3 symmetric(const glm::dmat2& m) {
  return {m[0][0], 0.5 * (m[0][1] + m[1][0]), m[1][1]};
}

bool finite(const LensmeterReading& reading) {
  return std::isfinite(reading.power.x + reading.power.y + reading.power.z) &&
         std::isfinite(reading.prism.x + reading.prism.y);
}

}  // namespace

Lensmeter::Lensmeter(const Lens& lens) {
  append_lens(model_, &lens, Side::right, 0.0);
}

f64::SurfacePoint Lensmeter::point_on(LensSide side, const glm::dvec2& point) const {
  const f64::LensData& lens = model_.lens.front();
  return f64::surface_point(f64::Table{model_.table}, side == LensSide::back ? lens.back : lens.front, point);
}

bool Lensmeter::within(const glm::dvec2& point) const {
  const double semi_diameter = model_.lens.front().glass.z;
  return dot(point, point) <= semi_diameter * semi_diameter;
}

std::optional<double> Lensmeter::thickness(const glm::dvec2& point) const {
  const f64::SurfacePoint back = point_on(LensSide::back, point), front = point_on(LensSide::front, point);
  if (!back.inside || !front.inside) {
    return std::nullopt;
  }
  return back.z + model_.lens.front().glass.y - front.z;
}

std::optional<double> Lensmeter::surface_power(LensSide side, const glm::dvec2& point) const {
  const f64::SurfacePoint s = point_on(side, point);
  if (!s.inside) {
    return std::nullopt;
  }
  // Mean curvature of a graph (do Carmo 1976, section 3.3).
  const double zx = s.gradient.x, zy = s.gradient.y, w2 = 1.0 + zx * zx + zy * zy;
  const double mean = ((1.0 + zy * zy) * s.hessian.x - 2.0 * zx * zy * s.hessian.y + (1.0 + zx * zx) * s.hessian.z) /
                      (2.0 * w2 * std::sqrt(w2));
  const double step = model_.lens.front().glass.x - 1.0;
  return (side == LensSide::front ? step : -step) * mean;
}

LensmeterReading Lensmeter::read(LensSide side, const glm::dvec2& point) const {
  return side == LensSide::back ? read_back(point) : read_front(point);
}

LensmeterReading Lensmeter::read_back(const glm::dvec2& point) const {
  LensmeterReading reading;
  const f64::SurfacePoint stop = point_on(LensSide::back, point);
  if (!stop.inside || !within(point)) {
    return reading;
  }
  const f64::LensData& lens = model_.lens.front();
  const glm::dvec3 beam = outward_normal(stop);
  f64::LensPath path =
      f64::trace_lens(f64::Table{model_.table}, lens, glm::dvec3(point, stop.z) - kStandOff * beam, beam);
  reading.status = static_cast<RayStatus>(path.status);
  if (reading.status != RayStatus::ok) {
    return reading;
  }
  path.t_back = 0.0;  // the vertex power belongs to the stop
  const Across axes = across(beam);
  bool regular = true;
  reading.power = symmetric(f64::vergence_matrix(f64::lens_transfer(lens, path, axes.h, axes.v), 0.0, regular));
  reading.prism = prism_dioptres(path.direction_object, beam, axes);
  reading.far_point = glm::dvec2(path.front_hit);
  reading.zone = zone_of(model_, point, reading.far_point);
  if (!regular || !finite(reading)) {
    reading.status = RayStatus::singular;
  }
  return reading;
}

// Light parallel to nothing but itself on the eye side, along the normal of the front surface on the scene side: the
// path is built from the front, by Newton's method to the back and Snell's law backwards.
LensmeterReading Lensmeter::read_front(const glm::dvec2& point) const {
  LensmeterReading reading;
  reading.status = RayStatus::miss_front;
  const f64::LensData& lens = model_.lens.front();
  const double index = lens.glass.x;
  f64::LensPath path{};
  path.front = point_on(LensSide::front, point);
  if (!path.front.inside || !within(point)) {
    return reading;
  }
  const glm::dvec3 beam = outward_normal(path.front);
  path.front_hit = glm::dvec3(point, path.front.z - lens.glass.y);
  if (!meet_back_from_inside(path, beam)) {
    reading.status = path.t_front > 0.0 ? RayStatus::miss_back : RayStatus::inverted;
    return reading;
  }
  // Snell's law keeps n times the part along the surface.
  const glm::dvec3 normal = outward_normal(path.back);
  const glm::dvec3 along = index * (beam - dot(beam, normal) * normal);
  const double under = 1.0 - dot(along, along);
  if (!(under > 0.0)) {
    reading.status = RayStatus::tir_front;  // at the far surface of a lens that stands on its front
    return reading;
  }
  path.direction = along + std::sqrt(under) * normal;
  path.direction_glass = path.direction_object = beam;
  bool transmitted = true;
  path.gamma_back =
      f64::refract_direction(path.direction, path.back.gradient, 1.0, index, path.direction_glass, transmitted);
  path.gamma_front = 1.0 - index;

  const Across axes = across(beam);
  const Across start = across(path.direction);
  glm::dvec3 e1 = start.h, e2 = start.v;
  f64::RayTransfer m = f64::refract_transfer(f64::free_flight(0.0), path.back, path.gamma_back, beam, e1, e2);
  m = f64::propagate_transfer(m, path.t_front / index);
  m = f64::refract_transfer(m, path.front, path.gamma_front, beam, e1, e2);
  // Collimated at the back, p = 0: the wave beyond the front has x = A x0, p = C x0 and converges by -C A^-1.
  const glm::dmat2 wave = -(m.c * f64::inverse2(m.a));
  const glm::dmat2 turn({dot(e1, axes.h), dot(e1, axes.v)}, {dot(e2, axes.h), dot(e2, axes.v)});
  reading.power = symmetric(turn * wave * glm::transpose(turn));
  reading.prism = -prism_dioptres(path.direction, beam, axes);
  reading.far_point = glm::dvec2(path.back_hit);
  reading.zone = zone_of(model_, reading.far_point, point);
  reading.status = finite(reading) ? RayStatus::ok : RayStatus::singular;
  return reading;
}

bool Lensmeter::meet_back_from_inside(f64::LensPath& path, const glm::dvec3& beam) const {
  // A lens's back is met within few steps or, at a rim too steep, never.
  constexpr int kSteps = 30;
  constexpr double kSettled = 1e-13;  // m; what then remains is its square
  path.t_front = thickness(glm::dvec2(path.front_hit)).value_or(model_.lens.front().glass.y);
  for (int i = 0; i < kSteps; ++i) {
    path.back_hit = path.front_hit - path.t_front * beam;
    path.back = point_on(LensSide::back, glm::dvec2(path.back_hit));
    const double slope = dot(beam, glm::dvec3(path.back.gradient, -1.0));
    const double step = (path.back_hit.z - path.back.z) / slope;
    if (!std::isfinite(step)) {
      return false;
    }
    path.t_front -= step;
    if (std::abs(step) <= kSettled) {
      return path.t_front > 0.0 && path.back.inside && within(glm::dvec2(path.back_hit));
    }
  }
  return false;
}

}  // namespace lenses
