#include "lenses/sag_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lenses/surface_model.hpp"

namespace lenses {
namespace {

// Half the side of the largest square about the origin that lies within a patch.
double patch_half(const f64::SurfaceData& surface, const Placement& placement) {
  const glm::dvec4& d = surface.domain;
  const glm::dvec2 c = placement.decentration;
  return std::min({-d.x - c.x, d.y + c.x, -d.z - c.y, d.w + c.y});
}

}  // namespace

SagGrid sag_grid(const Lens& lens, Face face, std::size_t count, std::optional<double> size) {
  const Surface& surface = face == Face::front ? lens.front : lens.back;
  const Placement& placement = face == Face::front ? lens.front_placement : lens.back_placement;
  if (std::holds_alternative<SegmentedSurface>(surface)) {
    throw std::invalid_argument("is a bifocal's, with a ledge that no table of heights holds");
  }
  std::vector<glm::dvec4> table;
  const f64::SurfaceData data = make_surface(surface, placement, 0.5 * lens.diameter, table);
  double side = size.value_or(lens.diameter);
  const bool patch =
      std::holds_alternative<BsplineHeightField>(surface) || std::holds_alternative<BsplineSurface>(surface);
  // A hair inside, so that rounding does not leave the patch.
  if (patch && !size) side = std::min(side, 2.0 * patch_half(data, placement) * (1.0 - 1e-12));
  if (!(side > 0.0)) throw std::invalid_argument("does not reach the lens axis");
  SagGrid grid{count, count, side, side, {}};
  grid.sag.reserve(count * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const f64::SurfacePoint point = f64::surface_point(f64::Table{table}, data, {grid.x(i), grid.y(j)});
      if (!point.inside && std::hypot(grid.x(i), grid.y(j)) <= 0.5 * lens.diameter) {
        throw std::invalid_argument("ends inside the lens");
      }
      grid.sag.push_back(point.inside ? point.z : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return grid;
}

}  // namespace lenses
