#include "app/report/csv.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace app {

Csv& Csv::add(std::string_view cell) {
  separate();
  if (cell.find_first_of(",\"\n\r") == std::string_view::npos) {
    text_ += cell;
    return *this;
  }
  text_ += '"';
  for (const char c : cell) {
    text_.append(c == '"' ? 2U : 1U, c);
  }
  text_ += '"';
  return *this;
}

Csv& Csv::add(std::optional<double> number) {
  separate();
  if (!number || !std::isfinite(*number)) {
    return *this;
  }
  std::array<char, 400> digits{};  // the largest double has 309 before the point
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), *number, std::chars_format::fixed, 6);
  std::string_view text(digits.data(), static_cast<std::size_t>(end.ptr - digits.data()));
  if (text.front() == '-' && text.find_first_of("123456789") == std::string_view::npos) {
    text.remove_prefix(1);  // a zero is one, whatever side of it rounding left it on
  }
  text_ += text;
  return *this;
}

Csv& Csv::empty(int cells) {
  for (int i = 0; i < cells; ++i) {
    separate();
  }
  return *this;
}

void Csv::end_row() {
  text_ += '\n';
  first_ = true;
}

void Csv::separate() {
  if (!first_) {
    text_ += ',';
  }
  first_ = false;
}

}  // namespace app
