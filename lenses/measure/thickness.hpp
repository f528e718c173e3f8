// How thick a lens is: along its axis at a point, and at its edge.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "lenses/lens.hpp"
#include "lenses/measure/lensmeter.hpp"

namespace lenses {

struct ThicknessAt {
  double thickness = 0.0;  // m, along the lens axis; negative where the surfaces have crossed
  glm::dvec2 at{0.0};      // m, lens axes
};

struct EdgeThickness {
  ThicknessAt least, greatest;
};

// Along the outline, or the blank's rim where there is none; none where no surface reaches it.
[[nodiscard]] std::optional<EdgeThickness> edge_thickness(const Lens& lens, const Lensmeter& lensmeter);

}  // namespace lenses
