#include "lenses/design/progressive_target.hpp"

#include <algorithm>
#include <cmath>

namespace lenses {
namespace {

// From 0 at t <= 0 to 1 at t >= 1, slope and bend continuous.
double smooth(double t) {
  const double c = std::clamp(t, 0.0, 1.0);
  return c * c * c * (10.0 - 15.0 * c + 6.0 * c * c);
}

// How much a place belongs to an area, from its distance inside the border and the width of the transition.
double belonging(double inside, double transition) {
  return smooth(0.5 + inside / transition);
}

}  // namespace

ProgressiveTarget::Place ProgressiveTarget::place(const glm::dvec2& p) const {
  const double below = config_.fitting_cross - p.y;
  const double t = std::clamp(below / config_.corridor_length, 0.0, 1.0);
  return {std::abs(p.x - t * config_.near_point().x), below};
}

// The share of the addition down the line. Its slope is a trapezoid: the lower its top, the wider the corridor can be
// (Minkwitz), the longer its flanks, the gentler the zones' ends.
double ProgressiveTarget::rise(double below) const {
  constexpr double kAboveCross = 0.0015, kAboveNear = 0.0005;
  const double flank = between(0.45, 0.2);
  const double t = std::clamp((below + kAboveCross) / (config_.corridor_length - kAboveNear + kAboveCross), 0.0, 1.0);
  const double top = 1.0 / (1.0 - flank), s = std::min(t, 1.0 - t);
  const double half = s < flank ? 0.5 * top * s * s / flank : top * (s - 0.5 * flank);
  return t < 0.5 ? half : 1.0 - half;
}

double ProgressiveTarget::in_zones(const Place& place) const {
  const double tilt = between(0.8, 0.3);  // of the distance zone's borders
  const double distance_inside = -(place.below + tilt * place.aside) / std::hypot(1.0, tilt) - between(0.001, 0.0);
  const double distance = belonging(distance_inside, between(0.012, 0.006));
  // Its centre below the near point, its straight part 6 mm high.
  constexpr double kBelowNear = 0.004, kStraight = 0.003;
  const double beyond = std::max(0.0, std::abs(place.below - config_.corridor_length - kBelowNear) - kStraight);
  const double near = belonging(between(0.005, 0.0065) - std::hypot(place.aside, beyond), between(0.010, 0.007));
  return 1.0 - (1.0 - distance) * (1.0 - near);
}

// The line goes on for a little beyond both points, so that they do not lie on the brink.
double ProgressiveTarget::on_line(const Place& place) const {
  constexpr double kHalfWidth = 0.0012, kTransition = 0.004, kAboveDistance = 0.002, kBelowNear = 0.004;
  const double above = config_.fitting_cross - config_.distance_point - kAboveDistance - place.below;
  const double beneath = place.below - config_.corridor_length - kBelowNear;
  return belonging(kHalfWidth - std::hypot(place.aside, std::max({0.0, above, beneath})), kTransition);
}

DesignTarget ProgressiveTarget::at(const glm::dvec2& p) const {
  // Cylinder at the sides costs 1. Power hardly matters there; on the line neither power nor cylinder may give way.
  constexpr double kPowerAtSides = 0.03, kPowerOnLine = 150.0, kCylinderOnLine = 300.0;
  constexpr double kBeyondRim = 0.02, kRim = 0.003;
  const Place here = place(p);
  const double zone = in_zones(here), line = on_line(here);
  // The net's corners are no part of the lens, but must go on from it.
  const double rim = smooth((0.5 * config_.diameter + kRim - glm::length(p)) / kRim);
  const double share = kBeyondRim + (1.0 - kBeyondRim) * rim;
  return {distance_ + addition_ * rise(here.below),
          share * (kPowerAtSides * std::pow(between(30.0, 60.0) / kPowerAtSides, zone) + kPowerOnLine * line),
          share * (std::pow(between(4.0, 10.0), zone) + kCylinderOnLine * line)};
}

}  // namespace lenses
