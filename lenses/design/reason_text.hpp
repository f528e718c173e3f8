// Numbers in the messages of a design that cannot be made.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace lenses::design {

// At most three decimals, none that says nothing.
[[nodiscard]] inline std::string number_in_words(double value) {
  std::array<char, 64> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, 3);
  if (end.ec != std::errc{}) {
    return std::to_string(value);
  }
  std::string text(digits.data(), end.ptr);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') {
    text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

[[nodiscard]] inline std::string in_mm(double metres) {
  return number_in_words(1e3 * metres) + " mm";
}

[[nodiscard]] inline std::string in_dioptres(double power) {
  return number_in_words(power) + " D";
}

}  // namespace lenses::design
