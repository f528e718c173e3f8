// Newton's method on what a lens does at its reference points: three numbers of power and two of prism against the
// three of one surface's curvature matrix and the two that give the lens prism.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "lenses/design/ordered_power.hpp"

namespace lenses::design {

struct LensUnknowns {
  glm::dmat2 curvature{0.0};  // of the surface that carries the cylinder, 1/m
  glm::dvec2 prismatic{0.0};  // gradient of the front, or where the optical centre is (m)
};

// What the lens of these unknowns does; none where light does not pass.
using LensMeasure = std::function<std::optional<PointPower>(const LensUnknowns&)>;

// Keeps `prismatic` as it is unless `with_prism`. None when nothing near the start meets the target.
[[nodiscard]] std::optional<LensUnknowns> solve_power(const LensUnknowns& start, const LensMeasure& measure,
                                                      const PointPower& target, bool with_prism);

}  // namespace lenses::design
