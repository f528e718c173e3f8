// A lens's surface as a table of heights.
#pragma once

#include <cstddef>
#include <optional>

#include "lenses/lens.hpp"
#include "lenses/lens_io/sag_file.hpp"

namespace lenses {

// Heights of a surface where it stands in the lens, without the centre thickness, on a square of `size` metres (absent:
// the lens's diameter, or less where a spline's patch ends), count by count. Outside the diameter the surface goes on
// as far as it exists. std::invalid_argument where it does not, or for a bifocal's, whose ledge no table holds.
[[nodiscard]] SagGrid sag_grid(const Lens& lens, Face face, std::size_t count,
                               std::optional<double> size = std::nullopt);

}  // namespace lenses
