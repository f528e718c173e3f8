#pragma once

#include "lenses/lens.hpp"
#include "lenses/lens_io/json_fields.hpp"

namespace lenses::io {

[[nodiscard]] BsplineHeightField read_bspline_height_field(const Field& surface);
[[nodiscard]] BsplineSurface read_bspline_surface(const Field& surface);

}  // namespace lenses::io
