// The words for a prism's base, which are the wearer's: in is towards the nose.
#pragma once

#include <numbers>
#include <optional>
#include <string_view>

#include "lenses/lens.hpp"

namespace lenses {

enum class PrismBase { up, down, in, out };

[[nodiscard]] constexpr std::optional<PrismBase> prism_base(std::string_view word) {
  if (word == "up") return PrismBase::up;
  if (word == "down") return PrismBase::down;
  if (word == "in") return PrismBase::in;
  if (word == "out") return PrismBase::out;
  return std::nullopt;
}

[[nodiscard]] constexpr bool known_by_side(PrismBase base) {
  return base == PrismBase::in || base == PrismBase::out;
}

// In TABO: 0 is to the examiner's right, where a right eye has its nose.
[[nodiscard]] constexpr double base_angle(PrismBase base, Side side) {
  constexpr double kPi = std::numbers::pi;
  switch (base) {
    case PrismBase::up:
      return 0.5 * kPi;
    case PrismBase::down:
      return 1.5 * kPi;
    case PrismBase::in:
      return side == Side::right ? 0.0 : kPi;
    case PrismBase::out:
      return side == Side::right ? kPi : 0.0;
  }
  return 0.0;
}

}  // namespace lenses
