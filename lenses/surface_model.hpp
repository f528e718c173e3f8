// A surface turned into the numbers the engines trace with.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "lenses/engine.hpp"
#include "lenses/lens.hpp"

namespace lenses {

// Appends to the table what the surface keeps there. Throws std::invalid_argument, with the reason, for a spline whose
// parametrisation folds over.
[[nodiscard]] f64::SurfaceData make_surface(const Surface& surface, const Placement& placement, double semi_diameter,
                                            std::vector<glm::dvec4>& table);

}  // namespace lenses
