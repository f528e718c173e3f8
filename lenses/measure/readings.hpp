// What an optician reads off a lens: its vertex powers at the reference points, its addition, its prism.
#pragma once

#include <optional>
#include <vector>

#include "lenses/lens.hpp"
#include "lenses/measure/lensmeter.hpp"

namespace lenses {

enum class ReferencePoint { distance, near, prism };

[[nodiscard]] constexpr const char* name(ReferencePoint point) {
  return point == ReferencePoint::distance ? "distance" : point == ReferencePoint::near ? "near" : "prism";
}

[[nodiscard]] constexpr const char* name(LensSide side) {
  return side == LensSide::back ? "back" : "front";
}

struct PointReading {
  ReferencePoint point = ReferencePoint::distance;
  LensSide side = LensSide::back;  // that stands on the lens stop
  glm::dvec2 at{0.0};              // m, lens axes
  LensmeterReading reading;
};

struct LensReadings {
  // Back vertex powers at distance, near (if the lens has a near point) and prism point; where the addition is on the
  // front, also the front vertex powers at distance and near.
  std::vector<PointReading> points;
  LensSide addition_side = LensSide::back;
  std::optional<double> addition;  // D, of mean powers; none without a near point that can be read

  [[nodiscard]] const PointReading* find(ReferencePoint point, LensSide side) const;
};

// A prism point that is not given is the lens's origin, a distance point that is not given the prism point.
[[nodiscard]] glm::dvec2 distance_point(const Lens& lens);
[[nodiscard]] glm::dvec2 prism_point(const Lens& lens);

// The addition is on the side whose own power changes more from the distance to the near point.
[[nodiscard]] LensReadings read_lens_powers(const Lens& lens, const Lensmeter& lensmeter);

}  // namespace lenses
