#pragma once

#include <initializer_list>
#include <string_view>

#include "lenses/lens.hpp"
#include "lenses/lens_io/json_fields.hpp"

namespace lenses::io {

// The keys by which any surface object says where it stands in the lens.
inline const std::initializer_list<std::string_view> kPlacementKeys = {"decentration_mm", "slope", "height_mm"};

[[nodiscard]] Placement read_placement(const Field& surface);

}  // namespace lenses::io
