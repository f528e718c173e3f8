// The parts that every lens object may have, whichever way it says what the lens is.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "lenses/lens.hpp"
#include "lenses/lens_io/json_fields.hpp"

namespace lenses::io {

inline constexpr double kLargestDiameterMm = 500.0;

// What the object does not say stays as in `fit`.
[[nodiscard]] Fit read_fit(const Field& object, Fit fit);
[[nodiscard]] ReferencePoints read_reference_points(const Field& object);
[[nodiscard]] std::vector<glm::dvec2> read_outline(const Field& object);
// The polygon of an object whose keys are checked.
[[nodiscard]] std::vector<glm::dvec2> read_outline_polygon(const Field& object);

}  // namespace lenses::io
