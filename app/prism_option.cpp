#include "app/prism_option.hpp"

#include <cmath>
#include <numbers>

#include "app/option_values.hpp"
#include "lenses/design/prism_base.hpp"
#include "tracking/input_error.hpp"

namespace app {

lenses::Prism prism_of(const std::string& option, const std::string& text, std::optional<lenses::Side> side) {
  const auto refuse = [&](const std::string& why) {
    throw tracking::InputError(option, "", std::string("'") + text + "' " + why);
  };
  const std::string form =
      "M@B with M a number of prism dioptres and B a base from 0 to 360 degrees (TABO), or up, down, in, out, such as "
      "2@in";
  const std::size_t at = text.find('@');
  if (at == std::string::npos) {
    refuse(std::string("is not ") + form);
  }
  lenses::Prism prism;
  prism.magnitude = numbers_of(option, text.substr(0, at), 1, form).front();
  check_range(option, prism.magnitude, 0.0, 40.0, "pd");
  const std::string base = text.substr(at + 1);
  if (const auto known = lenses::prism_base(base)) {
    if (!side && lenses::known_by_side(*known)) {
      refuse("needs --side right or left, which says where the nose is");
    }
    prism.base = lenses::base_angle(*known, side.value_or(lenses::Side::right));
    return prism;
  }
  const double degrees = numbers_of(option, base, 1, form).front();
  check_range(option, degrees, 0.0, 360.0, "degrees");
  prism.base = std::fmod(degrees, 360.0) * std::numbers::pi / 180.0;
  return prism;
}

}  // namespace app
