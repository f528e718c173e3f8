#pragma once

#include "lenses/lens.hpp"
#include "lenses/lens_io/json_fields.hpp"

namespace lenses::io {

[[nodiscard]] Eye read_eye_object(const Field& eye);
[[nodiscard]] Viewer read_viewer_object(const Field& viewer);

}  // namespace lenses::io
