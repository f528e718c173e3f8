#include "app/bench/bench_text.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace app {

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

int lens_width(const BenchReport& report) {
  std::size_t width = 16;
  for (const BenchRow& row : report.rows) {
    width = std::max(width, row.lens.size());
  }
  return static_cast<int>(width);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return out;
}

}  // namespace app
