// JSON values to text that is short, exact and readable: objects over several lines, arrays of numbers on one.
#pragma once

#include <cmath>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lenses::io {

// The shortest decimal that reads back as the same double; "null" when it is not finite.
[[nodiscard]] std::string number_text(double value);
// A JSON string with its quotes; bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string string_text(const std::string& text);
// A value rounded to so many significant decimal digits.
[[nodiscard]] double rounded(double value, int digits);
// With a newline at the end.
[[nodiscard]] std::string document_text(const nlohmann::ordered_json& value);

// A value in the file's unit whose decimals are few and which `read` turns into `si` again; `near` when there is none.
// A number of at most 12 digits may read back one rounding off, as 3.05 mm does from a literal of 0.00305 m: so short a
// decimal so near is what its author wrote.
template <class Read>
[[nodiscard]] double shortest_in_file(double si, double near, Read read) {
  const double plain = rounded(near, 12);
  if (std::abs(read(plain) - si) <= std::numeric_limits<double>::epsilon() * std::abs(si)) return plain;
  for (int digits = 15; digits <= 17; ++digits) {
    const double candidate = rounded(near, digits);
    if (read(candidate) == si) return candidate;
  }
  return near;
}

}  // namespace lenses::io
