#include "lenses/lens_io/written_number.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/units.hpp"

namespace lenses::io {

double written(double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("a number that is not finite cannot be written as JSON");
  return value;
}

double written_mm(double metres) {
  return shortest_in_file(written(metres), metres * 1e3, from_mm);
}

double written_um(double metres) {
  return shortest_in_file(written(metres), metres * 1e6, from_um);
}

double written_degrees(double radians) {
  return shortest_in_file(written(radians), radians / (std::numbers::pi / 180.0), from_degrees);
}

double written_even_coefficient(double value, std::size_t i) {
  const double scale = even_coefficient_scale(i);
  return shortest_in_file(written(value), value / scale, [scale](double mm) { return mm * scale; });
}

nlohmann::ordered_json written_radius_mm(double curvature) {
  const double radius_mm = 1e3 / written(curvature);
  if (!std::isfinite(radius_mm)) return nullptr;  // 0, or flatter than a double's reciprocal can say
  return shortest_in_file(curvature, radius_mm, curvature_from_radius_mm);
}

}  // namespace lenses::io
