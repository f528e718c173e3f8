#include "lenses/lens_io/sag_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "lenses/lens_io/json_document.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/oma_job.hpp"
#include "lenses/lens_io/units.hpp"
#include "tracking/input_error.hpp"

namespace lenses::io {

void TextLine::fail(const std::string& reason) const {
  const std::string place = "line " + std::to_string(number);
  throw tracking::InputError(file, label.empty() ? place : place + ": " + std::string(label), reason);
}

void for_each_line(std::string_view text, const std::function<void(std::size_t, std::string_view)>& take) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    take(number, text.substr(0, end));
    text.remove_prefix(std::min(end + (text.substr(end, 2) == "\r\n" ? 2 : 1), text.size()));
  }
}

void WrittenDigits::see(std::string_view text, double value) {
  if (value == 0.0) {
    ++zeros_;
    return;
  }
  exponents_.push_back(static_cast<int>(std::floor(std::log10(std::abs(value)))));
  const std::size_t mark = text.find_first_of("eE");
  const std::string_view mantissa = text.substr(0, mark);
  int exponent = 0;
  if (mark != std::string_view::npos) {
    std::string_view power = text.substr(mark + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    std::from_chars(power.data(), power.data() + power.size(), exponent);
  }
  const std::size_t point = mantissa.find('.');
  const int decimals = point == std::string_view::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  most_decimals_ = std::max(most_decimals_, decimals - exponent);
  most_significant_ = std::max(most_significant_, decimals - exponent + exponents_.back() + 1);
}

double WrittenDigits::noise() const {
  const auto square_step = [&](int power) { return std::pow(10.0, 2.0 * power); };
  double sum = static_cast<double>(zeros_) * square_step(-most_decimals_);
  for (const int exponent : exponents_) sum += square_step(std::max(-most_decimals_, exponent + 1 - most_significant_));
  const double count = static_cast<double>(zeros_ + exponents_.size());
  return count > 0.0 ? std::sqrt(sum / count / 12.0) : 0.0;
}

std::optional<double> sag_in(std::string_view text, const TextLine& line, std::size_t entry, WrittenDigits& digits) {
  const std::string_view word = trimmed(text);
  if (word == "?") return std::nullopt;
  const auto value = number_in(word);
  if (!value || std::abs(*value) > kMostSagMm) {
    line.fail("entry " + std::to_string(entry + 1) + " is " + in_quotes(word) + "; must be a number from " +
              number_text(-kMostSagMm) + " to " + number_text(kMostSagMm) + ", or ? where the surface is not known");
  }
  digits.see(word, *value);
  return value;
}

GridReader::GridReader(std::size_t columns, std::size_t rows, double width_mm, double height_mm, RowOrder order)
    : columns_(columns), rows_(rows), width_(width_mm), height_(height_mm), order_(order) {}

void GridReader::take_row(std::string_view text, char separator, const TextLine& line) {
  if (rows_taken_ == rows_) line.fail("is a row too many; the table has " + std::to_string(rows_));
  std::vector<std::string_view> entries = split(text, separator);
  // Some programs end every row with the separator.
  if (entries.size() == columns_ + 1 && trimmed(entries.back()).empty()) entries.pop_back();
  if (entries.size() != columns_) {
    line.fail("has " + std::to_string(entries.size()) + " numbers; the table has " + std::to_string(columns_) +
              " columns");
  }
  const std::size_t from_top = order_ == RowOrder::top_first ? rows_taken_ : rows_ - 1 - rows_taken_;
  const double y = height_ * (0.5 - static_cast<double>(from_top) / static_cast<double>(rows_ - 1));
  for (std::size_t k = 0; k < columns_; ++k) {
    const double viewers_x = width_ * (static_cast<double>(k) / static_cast<double>(columns_ - 1) - 0.5);
    const auto sag = sag_in(entries[k], line, k, digits_);
    if (sag) samples_.points.emplace_back(from_mm(-viewers_x), from_mm(y), from_mm(*sag));
  }
  ++rows_taken_;
}

SagSamples GridReader::finish() {
  samples_.noise = from_mm(digits_.noise());
  return std::move(samples_);
}

std::string fixed_text(double value, int decimals) {
  std::array<char, 400> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals).ptr;
  std::string result(text.data(), end);
  // A height that rounds to nothing has no sign.
  if (result.front() == '-' && result.find_first_of("123456789") == std::string::npos) result.erase(0, 1);
  return result;
}

void check_grid(const SagGrid& grid) {
  if (grid.columns < 2 || grid.rows < 2 || grid.sag.size() != grid.columns * grid.rows) {
    throw std::invalid_argument("a table has at least 2 columns and 2 rows and a height for each of their crossings");
  }
  if (std::ranges::any_of(grid.sag, [](double z) { return std::isinf(z); })) {
    throw std::invalid_argument("an infinite height cannot be written");
  }
}

std::vector<std::string> grid_rows(const SagGrid& grid, const SagWriting& writing, char separator) {
  check_grid(grid);
  std::vector<std::string> result;
  for (std::size_t r = 0; r < grid.rows; ++r) {
    const std::size_t j = writing.rows == RowOrder::top_first ? grid.rows - 1 - r : r;
    std::string row;
    for (std::size_t k = 0; k < grid.columns; ++k) {
      if (k > 0) row += separator;
      const double sag = grid.sag[(grid.columns - 1 - k) * grid.rows + j];
      row += std::isnan(sag) ? "?" : fixed_text(1e3 * sag, writing.decimals);
    }
    result.push_back(std::move(row));
  }
  return result;
}

}  // namespace lenses::io
