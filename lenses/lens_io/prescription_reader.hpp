#pragma once

#include <optional>

#include "lenses/design/lens_request.hpp"
#include "lenses/lens.hpp"
#include "lenses/lens_io/json_fields.hpp"

namespace lenses::io {

// A prescription as written: bases are degrees in TABO, or up, down, in, out; the last two need to know the eye.
[[nodiscard]] Prescription read_prescription(const Field& object, std::optional<Side> side);

// {"ordered": PRESCRIPTION, "compensated": PRESCRIPTION}
[[nodiscard]] Order read_order(const Field& object, std::optional<Side> side);

// A lens object that has a prescription in place of surfaces, made into a lens.
[[nodiscard]] Lens read_prescription_lens(const Field& lens, std::optional<Side> side);

}  // namespace lenses::io
