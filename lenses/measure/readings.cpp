#include "lenses/measure/readings.hpp"

#include <algorithm>
#include <cmath>

#include "lenses/measure/power.hpp"

namespace lenses {
namespace {

double change_of(const Lensmeter& lensmeter, LensSide side, const glm::dvec2& distance, const glm::dvec2& near) {
  const auto there = lensmeter.surface_power(side, near), here = lensmeter.surface_power(side, distance);
  return there && here ? std::abs(*there - *here) : 0.0;
}

}  // namespace

const PointReading* LensReadings::find(ReferencePoint point, LensSide side) const {
  const auto found =
      std::ranges::find_if(points, [&](const PointReading& r) { return r.point == point && r.side == side; });
  return found == points.end() ? nullptr : &*found;
}

glm::dvec2 prism_point(const Lens& lens) {
  return lens.reference_points.prism.value_or(glm::dvec2(0.0));
}

glm::dvec2 distance_point(const Lens& lens) {
  return lens.reference_points.distance.value_or(prism_point(lens));
}

LensReadings read_lens_powers(const Lens& lens, const Lensmeter& lensmeter) {
  LensReadings result;
  const auto read = [&](ReferencePoint point, LensSide side, const glm::dvec2& at) {
    result.points.push_back({point, side, at, lensmeter.read(side, at)});
  };
  const glm::dvec2 distance = distance_point(lens);
  const std::optional<glm::dvec2> near = lens.reference_points.near;
  read(ReferencePoint::distance, LensSide::back, distance);
  if (near) {
    read(ReferencePoint::near, LensSide::back, *near);
  }
  read(ReferencePoint::prism, LensSide::back, prism_point(lens));
  if (!near) {
    return result;
  }
  // Rounding must not send a lens of one power to its front.
  constexpr double kMore = 1e-6;  // D
  if (change_of(lensmeter, LensSide::front, distance, *near) >
      change_of(lensmeter, LensSide::back, distance, *near) + kMore) {
    result.addition_side = LensSide::front;
    read(ReferencePoint::distance, LensSide::front, distance);
    read(ReferencePoint::near, LensSide::front, *near);
  }
  const PointReading* from = result.find(ReferencePoint::distance, result.addition_side);
  const PointReading* to = result.find(ReferencePoint::near, result.addition_side);
  if (from->reading.status == RayStatus::ok && to->reading.status == RayStatus::ok) {
    result.addition = mean_power(to->reading.power) - mean_power(from->reading.power);
  }
  return result;
}

}  // namespace lenses
