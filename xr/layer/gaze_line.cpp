#include "xr/layer/gaze_line.hpp"

#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>

namespace xr::layer {
namespace {

constexpr std::size_t kColumns = 15;
constexpr std::size_t kLeft = 8, kRight = 11, kValid = 14;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string_view column_name(std::size_t column) {
  std::string_view names = kGazeHeader;
  for (; column > 0; --column) {
    names.remove_prefix(names.find(',') + 1);
  }
  return names.substr(0, names.find(','));
}

bool read_number(std::string_view text, double& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
}

}  // namespace

std::variant<GazeRow, std::string> parse_gaze_line(std::string_view line) {
  std::array<double, kColumns> numbers{};
  for (std::size_t column = 0; column < kColumns; ++column) {
    const auto comma = line.find(',');
    if (!read_number(trimmed(line.substr(0, comma)), numbers[column])) {
      return std::string(column_name(column)) + " is not a finite number";
    }
    if (comma == std::string_view::npos && column + 1 < kColumns) {
      return std::to_string(column + 1) + " columns; " + std::to_string(kColumns) +
             " or more are needed: " + std::string(kGazeHeader);
    }
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
  GazeRow row{.time = numbers[0], .valid = numbers[kValid] == 1.0};
  if (!row.valid && numbers[kValid] != 0.0) {
    return std::string("gaze_valid is neither 0 nor 1");
  }
  if (row.valid) {
    const glm::dvec3 right(numbers[kRight], numbers[kRight + 1], numbers[kRight + 2]);
    const glm::dvec3 left(numbers[kLeft], numbers[kLeft + 1], numbers[kLeft + 2]);
    const auto is_direction = [](const glm::dvec3& d) { return std::isnormal(glm::dot(d, d)); };
    if (!is_direction(right) || !is_direction(left)) {
      return std::string("gaze_valid is 1 and a gaze direction has no length");
    }
    row.direction = {glm::normalize(right), glm::normalize(left)};  // by Side
  }
  return row;
}

}  // namespace xr::layer
