// Which parts of segmented surfaces a ray has passed.
#pragma once

#include "lenses/lens_model.hpp"

namespace lenses {

// Equal for rays that pass the back and the front on the same sides of the segments' edges; power is continuous only
// among those. Points in lens axes.
[[nodiscard]] inline int zone_of(const LensModel& model, const glm::dvec2& back_point, const glm::dvec2& front_point) {
  const f64::LensData& lens = model.lens.front();
  const f64::Table table{model.table};
  return (f64::in_segment(table, lens.back, back_point) ? 1 : 0) +
         (f64::in_segment(table, lens.front, front_point) ? 2 : 0);
}

}  // namespace lenses
