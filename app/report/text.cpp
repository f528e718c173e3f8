#include "app/report/text.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace app {
namespace {

// Whatever side of it rounding left a zero on.
std::string without_sign_of_zero(std::string text) {
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return zero && (text.front() == '-' || text.front() == '+') ? text.substr(1) : text;
}

}  // namespace

std::string format(const char* pattern, ...) {
  std::va_list arguments, again;
  va_start(arguments, pattern);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, pattern, arguments);
  va_end(arguments);
  std::string text(static_cast<std::size_t>(std::max(length, 0)), ' ');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  return text;
}

std::string number(std::optional<double> value, int decimals) {
  return value ? without_sign_of_zero(format("%.*f", decimals, *value)) : "-";
}

std::string signed_number(std::optional<double> value, int decimals) {
  return value ? without_sign_of_zero(format("%+.*f", decimals, *value)) : "-";
}

}  // namespace app
