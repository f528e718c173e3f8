// Lens materials by their trade names.
#pragma once

#include <span>
#include <string_view>

namespace lenses {

struct Material {
  std::string_view name;
  double index;    // at 587.6 nm (d line)
  double abbe;     // Abbe number at the same line
  double density;  // kg/m^3
};

[[nodiscard]] std::span<const Material> materials();

// nullptr for a name that is not in the table. Case counts: MR-8 and mr-8 are not the same word.
[[nodiscard]] const Material* find_material(std::string_view name);

}  // namespace lenses
