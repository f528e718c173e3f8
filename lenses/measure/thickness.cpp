#include "lenses/measure/thickness.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "lenses/measure/lens_outline.hpp"

namespace lenses {

std::optional<EdgeThickness> edge_thickness(const Lens& lens, const Lensmeter& lensmeter) {
  std::optional<EdgeThickness> result;
  const std::vector<glm::dvec2> edge = edge_of(lens);
  double length = 0.0;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    length += glm::distance(edge[i], edge[(i + 1) % edge.size()]);
  }
  // Half a millimetre; a frame's edge is well below a metre, but a file may hold any polygon.
  const double step_length = std::max(5e-4, 1e-4 * length);
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const glm::dvec2 from = edge[i], to = edge[(i + 1) % edge.size()];
    const int steps = std::max(1, static_cast<int>(std::ceil(glm::distance(from, to) / step_length)));
    for (int k = 0; k < steps; ++k) {
      const glm::dvec2 point = from + (to - from) * (static_cast<double>(k) / steps);
      const auto thickness = lensmeter.thickness(point);
      if (!thickness) {
        continue;
      }
      const ThicknessAt here{*thickness, point};
      if (!result) {
        result = EdgeThickness{here, here};
      } else if (here.thickness < result->least.thickness) {
        result->least = here;
      } else if (here.thickness > result->greatest.thickness) {
        result->greatest = here;
      }
    }
  }
  return result;
}

}  // namespace lenses
