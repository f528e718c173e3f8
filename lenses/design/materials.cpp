#include "lenses/design/materials.hpp"

#include <algorithm>
#include <array>

namespace lenses {
namespace {

// Makers' data sheets.
constexpr std::array kMaterials{
    Material{"crown", 1.523, 59.0, 2540.0},  Material{"CR-39", 1.498, 58.0, 1320.0},
    Material{"Trivex", 1.532, 44.0, 1110.0}, Material{"polycarbonate", 1.586, 30.0, 1200.0},
    Material{"MR-8", 1.600, 41.0, 1300.0},   Material{"MR-7", 1.670, 31.0, 1350.0},
    Material{"MR-10", 1.670, 31.0, 1370.0},  Material{"MR-174", 1.740, 32.0, 1470.0},
};

}  // namespace

std::span<const Material> materials() {
  return kMaterials;
}

const Material* find_material(std::string_view name) {
  const auto found = std::ranges::find(kMaterials, name, &Material::name);
  return found == kMaterials.end() ? nullptr : &*found;
}

}  // namespace lenses
