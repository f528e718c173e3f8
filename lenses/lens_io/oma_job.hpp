// Job files of the trade (OMA / VCA Data Communication Standard: .oma .vca .lds .lms) as lines of LABEL=value. A job
// keeps every line as it was read, its ending included, so that what nobody here understands survives a round trip byte
// for byte; oma_order.hpp and sdf.hpp say what the records mean.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lenses/lens.hpp"

namespace lenses::io {

struct OmaLine {
  std::string text, ending;  // ending: "\r\n", "\n", "\r", or "" at the end of a file

  [[nodiscard]] std::string_view label() const;  // empty on a blank line
  [[nodiscard]] std::string_view value() const;
};

struct OmaJob {
  std::string file;  // the name that errors carry
  std::vector<OmaLine> lines;

  [[nodiscard]] std::string text() const;
  // The place for an InputError's field: "line 3: SPH".
  [[nodiscard]] std::string place(std::size_t line) const;
  [[noreturn]] void fail(std::size_t line, const std::string& reason) const;

  // The line that holds a record; none: nullopt. A label given twice is an InputError.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view label) const;
  // The record's value for an eye: its part of right;left, or the lone one. Absent, empty or "?": nullopt.
  [[nodiscard]] std::optional<std::string_view> value_of(std::string_view label, Side side) const;
  // The same as a number from low to high.
  [[nodiscard]] std::optional<double> number_of(std::string_view label, Side side, double low, double high) const;

  // Replaces the record's value in its line, or adds a line ahead of the first trace or surface.
  void set(std::string_view label, std::string_view value);
};

// Throws tracking::InputError for a line that is neither blank nor LABEL=value.
[[nodiscard]] OmaJob parse_oma(std::string_view text, const std::string& file);
[[nodiscard]] OmaJob read_oma(const std::string& path);

[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);
[[nodiscard]] std::string_view trimmed(std::string_view text);
// The whole text as a finite number; a leading + and spaces around are allowed.
[[nodiscard]] std::optional<double> number_in(std::string_view text);

}  // namespace lenses::io
