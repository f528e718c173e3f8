// Files that may hold one lens or a pair.
#pragma once

#include <string>
#include <variant>

#include "lenses/lens.hpp"

namespace lenses {

// A pair when the file has "right" or "left" at its top.
[[nodiscard]] std::variant<Lens, Spectacles> read_lens_or_spectacles(const std::string& path);

}  // namespace lenses
