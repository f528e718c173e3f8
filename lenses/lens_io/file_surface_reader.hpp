#pragma once

#include "lenses/lens.hpp"
#include "lenses/lens_io/json_fields.hpp"

namespace lenses::io {

// A surface object of type "file": the spline fitted to a tabulated surface (sag_file.hpp). Its path starts at the
// folder of the lens file and may not leave it.
[[nodiscard]] BsplineHeightField read_file_surface(const Field& surface);

}  // namespace lenses::io
