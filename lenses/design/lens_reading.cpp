// The focimeter of ISO 8598 on a lens in the making: a beam normal to one surface at the point under test, collimated
// on the other side.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lenses/design/lens_shape.hpp"

namespace lenses::design {
namespace {

constexpr int kMostSteps = 60;
constexpr double kSettled = 1e-15;  // m, a hundred times below what a micrometre of wavefront would need

using Heights = std::function<f64::SurfacePoint(const glm::dvec2&)>;

// Turned front to back: the light then passes it the other way.
f64::SurfacePoint turned(f64::SurfacePoint point) {
  point.z = -point.z;
  point.gradient = -point.gradient;
  point.hessian = -point.hessian;
  return point;
}

// Newton's method from the stop's surface outwards: the beam is never far from the axis's direction.
struct Crossing {
  bool found = false;
  double t = 0.0;
  f64::SurfacePoint point{};
};

Crossing crossing(const Heights& far, const glm::dvec3& from, const glm::dvec3& d) {
  Crossing result;
  for (int step = 0; step < kMostSteps; ++step) {
    const glm::dvec3 p = from + result.t * d;
    result.point = far({p.x, p.y});
    const double slope = d.z - dot(result.point.gradient, glm::dvec2(d));
    const double change = (p.z - result.point.z) / slope;
    if (!result.point.inside || !std::isfinite(change)) {
      return result;
    }
    result.t -= change;
    if (std::abs(change) < kSettled) {
      result.found = result.t >= 0.0;
      return result;
    }
  }
  return result;
}

// The curvature of a height field across its normal, in the basis e1, e2 of its tangent plane.
glm::dmat2 curvature_across(const f64::SurfacePoint& s, const glm::dvec3& e1, const glm::dvec3& e2) {
  const double w = std::sqrt(1.0 + dot(s.gradient, s.gradient));
  const glm::dmat2 hessian(s.hessian.x, s.hessian.y, s.hessian.y, s.hessian.z);
  const glm::dmat2 basis{glm::dvec2(e1), glm::dvec2(e2)};  // columns: components along the tangents (1, 0), (0, 1)
  return transpose(basis) * hessian * basis / w;
}

// near: the surface on the stop, far: the other; the beam goes towards -z.
std::optional<PointPower> reading(const Heights& near, const Heights& far, double index, const glm::dvec2& point) {
  const f64::SurfacePoint stop = near(point);
  if (!stop.inside) {
    return std::nullopt;
  }
  const glm::dvec3 d = normalize(glm::dvec3(stop.gradient, -1.0));
  const Crossing exit = crossing(far, {point, stop.z}, d);
  glm::dvec3 beyond(0.0);
  bool transmitted = false;
  if (!exit.found) {
    return std::nullopt;
  }
  const double gamma = f64::refract_direction(d, exit.point.gradient, index, 1.0, beyond, transmitted);
  if (!transmitted) {
    return std::nullopt;
  }
  const glm::dvec3 e_h = f64::pupil_basis_h(d);
  const glm::dvec3 e_v = cross(e_h, d);
  glm::dvec3 e1 = e_h;
  glm::dvec3 e2 = e_v;
  f64::RayTransfer transfer = f64::propagate_transfer(f64::free_flight(0.0), exit.t / index);
  transfer = f64::refract_transfer(transfer, exit.point, gamma, beyond, e1, e2);
  bool regular = true;
  const glm::dmat2 in_glass = f64::vergence_matrix(transfer, 0.0, regular);
  if (!regular) {
    return std::nullopt;
  }
  PointPower result;
  result.power = in_glass - (index - 1.0) * curvature_across(stop, e_h, e_v);
  const glm::dvec3 bend = beyond / dot(beyond, d);
  result.prism = 100.0 * glm::dvec2(dot(bend, e_h), dot(bend, e_v));
  return result;
}

}  // namespace

std::optional<PointPower> reading_at_back(const LensShape& lens, const glm::dvec2& point) {
  return reading([&](const glm::dvec2& xy) { return lens.back(xy); },
                 [&](const glm::dvec2& xy) { return lens.front(xy); }, lens.lens().index, point);
}

std::optional<PointPower> reading_at_front(const LensShape& lens, const glm::dvec2& point) {
  return reading([&](const glm::dvec2& xy) { return turned(lens.front(xy)); },
                 [&](const glm::dvec2& xy) { return turned(lens.back(xy)); }, lens.lens().index, point);
}

}  // namespace lenses::design
