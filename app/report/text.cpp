#include "app/report/text.hpp"

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
  std::va_list arguments;
  va_start(arguments, pattern);
  char text[512];
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string number(std::optional<double> value, int decimals) {
  return value ? without_sign_of_zero(format("%.*f", decimals, *value)) : "-";
}

std::string signed_number(std::optional<double> value, int decimals) {
  return value ? without_sign_of_zero(format("%+.*f", decimals, *value)) : "-";
}

}  // namespace app
