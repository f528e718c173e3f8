#include "render/ladder.hpp"

#include <algorithm>
#include <array>

namespace render {
namespace {

constexpr std::array kLadder{
    Rung{.name = "standard",
         .subject = "standard",
         .what = "every pixel through the exact lens, disc blur",
         .accuracy = {}},
};

}  // namespace

std::span<const Rung> ladder() {
  return kLadder;
}

const Rung* find_rung(std::string_view name) {
  const auto found = std::ranges::find(kLadder, name, &Rung::name);
  return found == kLadder.end() ? nullptr : &*found;
}

}  // namespace render
