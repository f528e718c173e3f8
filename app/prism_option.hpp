// A prism on the command line: "2@in", "0.5@180".
#pragma once

#include <optional>
#include <string>

#include "lenses/lens.hpp"

namespace app {

// M@B: prism dioptres, and a base in TABO degrees (0 to 360) or as up, down, in, out; in and out need a side. Throws
// InputError with the option's name.
[[nodiscard]] lenses::Prism prism_of(const std::string& option, const std::string& text,
                                     std::optional<lenses::Side> side);

}  // namespace app
