// A lens's thickness over the outline it is cut to.
#pragma once

#include <optional>
#include <vector>

#include "lenses/design/lens_shape.hpp"

namespace lenses::design {

// Points along the edge, close together: the outline's, or the round lens's.
[[nodiscard]] std::vector<glm::dvec2> edge_points(const std::vector<glm::dvec2>& outline, double diameter);

struct ThicknessRange {
  double thinnest_edge, thickest_edge, thinnest;  // m; thinnest: anywhere inside
};

// None where a surface ends inside the edge.
[[nodiscard]] std::optional<ThicknessRange> thickness_range(const LensShape& lens, const std::vector<glm::dvec2>& edge);

// Of the glass within the edge, m^3.
[[nodiscard]] double volume(const LensShape& lens, const std::vector<glm::dvec2>& edge);

}  // namespace lenses::design
