#include "app/prism_option.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "lenses/design/prism_base.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

// A number, finite and alone.
std::optional<double> number_in(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool good = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
  return good ? std::optional(value) : std::nullopt;
}

}  // namespace

lenses::Prism prism_of(const std::string& option, const std::string& text, std::optional<lenses::Side> side) {
  const std::size_t at = std::min(text.find('@'), text.size());
  const std::optional<double> magnitude = number_in(text.substr(0, at));
  const std::string base = text.substr(std::min(at + 1, text.size()));
  const std::optional<lenses::PrismBase> word = lenses::prism_base(base);
  const std::optional<double> degrees = number_in(base);
  if (!magnitude || !(word || (degrees && *degrees >= 0.0 && *degrees <= 360.0))) {
    throw tracking::InputError(option, "",
                               "'" + text +
                                   "' is not M@B with M prism dioptres and B a base from 0 to 360 degrees (TABO), or "
                                   "up, down, in, out, such as 2@in");
  }
  if (!word) {
    return {*magnitude, std::fmod(*degrees, 360.0) * std::numbers::pi / 180.0};
  }
  if (!side && lenses::known_by_side(*word)) {
    throw tracking::InputError(option, "", "'" + text + "' needs --side right or left, which says where the nose is");
  }
  return {*magnitude, lenses::base_angle(*word, side.value_or(lenses::Side::right))};
}

}  // namespace app
