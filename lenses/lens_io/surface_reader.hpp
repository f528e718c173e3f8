#pragma once

#include "lenses/lens.hpp"
#include "lenses/lens_io/json_fields.hpp"

namespace lenses::io {

// A surface object of a lens file, by its "type"; where it stands is read_placement's.
[[nodiscard]] Surface read_surface(const Field& surface);

}  // namespace lenses::io
