// SI numbers in a file's units, for the writers: finite, and short where a short number reads back exactly.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

namespace lenses::io {

// All throw std::invalid_argument when the number is not finite.
[[nodiscard]] double written(double value);  // in the same unit
[[nodiscard]] double written_mm(double metres);
[[nodiscard]] double written_um(double metres);
[[nodiscard]] double written_degrees(double radians);
[[nodiscard]] double written_even_coefficient(double value, std::size_t i);
[[nodiscard]] nlohmann::ordered_json written_radius_mm(double curvature);  // null for flat

}  // namespace lenses::io
