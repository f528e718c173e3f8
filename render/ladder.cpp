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
    Rung{.name = "lens-1-iteration",
         .subject = "lens iterations",
         .what = "one step of Newton's method for each surface",
         .accuracy = {.lens = {.iterations = 1}}},
    Rung{.name = "lens-2-iterations",
         .subject = "lens iterations",
         .what = "two steps of Newton's method for each surface",
         .accuracy = {.lens = {.iterations = 2}}},
    Rung{.name = "lens-3-iterations",
         .subject = "lens iterations",
         .what = "three steps of Newton's method for each surface, as the paper takes",
         .accuracy = {.lens = {.iterations = 3}}},
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
