#include "lenses/design/surface_making.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "lenses/design/lens_shape.hpp"
#include "lenses/design/ordered_power.hpp"

namespace lenses::design {
namespace {

constexpr double kRound = 1e-9;             // 1/m; less is no toric surface, and flat
constexpr double kFarthestCentring = 0.05;  // m

double curvature_of_sphere(const Surface& surface) {
  const auto* sphere = std::get_if<Sphere>(&surface);
  return sphere == nullptr ? 0.0 : sphere->curvature;
}

// Where on a sphere about the origin's vertex the surface has this gradient.
glm::dvec2 place_of_gradient(double curvature, const glm::dvec2& gradient) {
  return gradient / (curvature * std::sqrt(1.0 + dot(gradient, gradient)));
}

// As a difference that keeps its digits for flat spheres.
double sphere_sag(double c, const glm::dvec2& p) {
  const double r2 = dot(p, p);
  return c * r2 / (1.0 + std::sqrt(1.0 - c * c * r2));
}

double largest_curvature(const BasicSurface& surface) {
  if (const auto* s = std::get_if<Sphere>(&surface)) return std::abs(s->curvature);
  if (const auto* s = std::get_if<Conic>(&surface)) return std::abs(s->curvature);
  if (const auto* s = std::get_if<Torus>(&surface)) return std::max(std::abs(s->curvature_u), std::abs(s->curvature_v));
  return 0.0;
}

double largest_curvature(const Surface& surface) {
  if (const auto* s = std::get_if<SegmentedSurface>(&surface)) {
    return std::max(largest_curvature(s->base), largest_curvature(s->segment));
  }
  return std::visit(
      [](const auto& s) -> double {
        if constexpr (std::is_same_v<std::decay_t<decltype(s)>, SegmentedSurface>) {
          return 0.0;
        } else {
          return largest_curvature(BasicSurface(s));
        }
      },
      surface);
}

// The part of a circle below its chord at height `top`, counter-clockwise.
std::vector<glm::dvec2> circle_below(const glm::dvec2& centre, double radius, double top) {
  constexpr int kCorners = 120;
  const double opening = std::asin(std::clamp((top - centre.y) / radius, -1.0, 1.0));
  const double from = std::numbers::pi - opening;
  const double to = 2.0 * std::numbers::pi + opening;
  std::vector<glm::dvec2> points;
  for (int i = 0; i <= kCorners; ++i) {
    const double a = from + (to - from) * i / kCorners;
    points.push_back(centre + radius * glm::dvec2(std::cos(a), std::sin(a)));
  }
  if (opening > 0.5 * std::numbers::pi - 1e-9) {
    points.pop_back();  // a full circle ends where it began
  }
  return points;
}

}  // namespace

double vogel_base_curve(double mean_power) {
  return mean_power >= 0.0 ? mean_power + 6.0 : std::max(0.5, 0.5 * mean_power + 6.0);
}

Surface toric_surface(const glm::dmat2& curvature, ToricForm form, bool simplest) {
  const Meridians m = meridians(curvature);
  if (simplest && m.first - m.second < kRound) {
    const double c = 0.5 * (m.first + m.second);
    return std::abs(c) < kRound ? Surface(Plane{}) : Surface(Sphere{c});
  }
  // With revolve u the arc of curvature v is turned.
  const bool first_steeper = std::abs(m.first) >= std::abs(m.second);
  const bool turn_first = first_steeper == (form == ToricForm::tyre);
  const double axis = turn_first ? m.axis + 0.5 * std::numbers::pi : m.axis;
  // Rounding must not make 180 degrees of 0.
  const double folded = axis - std::numbers::pi * std::floor((axis + 1e-12) / std::numbers::pi);
  return turn_first ? Torus{m.second, m.first, folded, Torus::Revolve::u}
                    : Torus{m.first, m.second, folded, Torus::Revolve::u};
}

Placement tilted(const Surface& surface, const glm::dvec2& gradient) {
  Placement placement;
  const double c = curvature_of_sphere(surface);
  if (c != 0.0) {
    const glm::dvec2 p = place_of_gradient(c, gradient);
    if (length(p) <= kFarthestCentring) {
      placement.decentration = -p;
      placement.height = -sphere_sag(c, p);
      return placement;
    }
  }
  placement.slope = gradient;
  return placement;
}

Placement decentred(const Surface& surface, const glm::dvec2& centre) {
  Placement placement;
  placement.decentration = centre;
  placement.height = -PlacedSurface(surface, placement).at({0.0, 0.0}).z;
  return placement;
}

double widest_diameter(const Surface& surface, const Placement& placement) {
  const double c = largest_curvature(surface);
  return c > 0.0 ? 1.8 / c - 2.0 * length(placement.decentration) : std::numeric_limits<double>::infinity();
}

SegmentLayout segment_layout(const LensRequest& request) {
  const double x = request.side == Side::right ? -request.inset : request.inset;
  const double top = request.segment_top;
  constexpr double kNearBelowTop = 0.005;
  SegmentLayout layout;
  layout.top = top;
  layout.near_point = {x, top - kNearBelowTop};
  switch (request.segment) {
    case SegmentShape::ft28:
      layout.radius = 0.014;
      layout.optical_centre = {x, top - 0.005};
      break;
    case SegmentShape::r24:
      layout.radius = 0.012;
      layout.optical_centre = {x, top - 0.012};
      break;
    case SegmentShape::executive:
      layout.optical_centre = {x, top};
      break;
  }
  return layout;
}

SegmentedSurface bifocal_front(const LensRequest& request, double base_curvature, double segment_curvature,
                               const glm::dvec2& centre) {
  const SegmentLayout layout = segment_layout(request);
  const glm::dvec2 at = layout.optical_centre;
  const glm::dvec2 on_base = at - centre;
  const double steep = std::sqrt(1.0 - base_curvature * base_curvature * dot(on_base, on_base));
  const glm::dvec2 on_segment = place_of_gradient(segment_curvature, base_curvature * on_base / steep);
  SegmentedSurface surface{Sphere{base_curvature}, Sphere{segment_curvature}, {}, {}};
  // Two spheres with a common tangent, `at`; their distance grows with the circle about it.
  surface.segment_placement.decentration = at - on_segment - centre;
  if (layout.radius > 0.0) {
    surface.boundary = circle_below(at, layout.radius, layout.top);
  } else {
    constexpr double kBeyond = 0.1;  // m, past any lens
    surface.boundary = {{kBeyond, layout.top}, {-kBeyond, layout.top}, {-kBeyond, -kBeyond}, {kBeyond, -kBeyond}};
  }
  // The spheres meet along a circle about their common normal; seen along the lens axis it is nearly the boundary's.
  const glm::dvec2 down(0.0, layout.radius);
  const auto gap = [&](const glm::dvec2& p) {
    return sphere_sag(base_curvature, p - centre) -
           sphere_sag(segment_curvature, p - centre - surface.segment_placement.decentration);
  };
  surface.segment_placement.height = 0.5 * (gap(at + down) + gap(at - down));
  return surface;
}

}  // namespace lenses::design
