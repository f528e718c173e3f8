#pragma once

#include <optional>

#include "lenses/lens.hpp"
#include "lenses/lens_io/json_fields.hpp"

namespace lenses::io {

// A lens object, be it a file of its own, one of a pair, or part of a trace request; the side where that is known.
[[nodiscard]] Lens read_lens_object(const Field& lens, std::optional<Side> side);

}  // namespace lenses::io
