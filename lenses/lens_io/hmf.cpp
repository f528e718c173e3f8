// HMF, a square table of heights in millimetres:
//   File Version=1.2 / [Properties] / Count=71 / Interval=1 / [Data] / a row of comma-separated heights a line
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lenses/lens_io/json_document.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/oma_job.hpp"
#include "lenses/lens_io/sag_text.hpp"
#include "tracking/input_error.hpp"

namespace lenses {
namespace io {
namespace {

class HmfReader {
 public:
  HmfReader(const std::string& file, RowOrder rows) : file_(file), rows_(rows) {}

  void take(std::size_t number, std::string_view text) {
    const std::string_view line = trimmed(text);
    if (line.empty()) return;
    if (line.front() == '[') {
      open_section({file_, number, {}}, line);
    } else if (grid_) {
      grid_->take_row(line, ',', {file_, number, {}});
    } else {
      take_property(number, line);
    }
  }

  SagFile finish() {
    if (!grid_) throw tracking::InputError(file_, "[Data]", "is missing; the rows of heights must follow it");
    if (grid_->rows_taken() < grid_->rows()) {
      throw tracking::InputError(
          file_, "[Data]",
          "holds " + std::to_string(grid_->rows_taken()) + " rows; Count is " + std::to_string(grid_->rows()));
    }
    return {std::nullopt, std::nullopt, grid_->finish()};
  }

 private:
  void open_section(const TextLine& line, std::string_view name) {
    if (name == "[Properties]" && !in_properties_ && !grid_) {
      in_properties_ = true;
    } else if (name == "[Data]" && in_properties_ && !grid_) {
      if (!count_) throw tracking::InputError(file_, "Count", "is missing; it must stand before [Data]");
      if (!interval_) throw tracking::InputError(file_, "Interval", "is missing; it must stand before [Data]");
      const double size = *interval_ * static_cast<double>(*count_ - 1);
      if (size > kMostSizeMm) {
        line.fail("opens a table of " + number_text(size) + " mm; up to " + number_text(kMostSizeMm) +
                  " mm is allowed");
      }
      grid_.emplace(*count_, *count_, size, size, rows_);
    } else {
      line.fail("is " + in_quotes(name) + "; [Properties] and then [Data] are allowed, once each");
    }
  }

  void take_property(std::size_t number, std::string_view text) {
    const std::size_t equals = text.find('=');
    const std::string_view name = trimmed(text.substr(0, equals));
    const TextLine line{file_, number, equals == std::string_view::npos ? std::string_view() : name};
    if (equals == std::string_view::npos) line.fail("is " + in_quotes(text) + "; must be NAME=value");
    const std::string_view word = trimmed(text.substr(equals + 1));
    const auto value = number_in(word);
    if (!in_properties_) {
      // Ahead of the properties: the version, and whatever a program says about itself.
      if (name == "File Version" && !(value && *value >= 1.0 && *value < 2.0)) {
        line.fail("is " + in_quotes(word) + "; version 1 is read");
      }
    } else if (name == "Count") {
      if (count_) line.fail("is given twice; it may appear once");
      if (!value || *value != std::floor(*value) || *value < double{kFewestPlaces} || *value > 1000.0) {
        line.fail("is " + in_quotes(word) + "; must be a whole number from " + std::to_string(kFewestPlaces) +
                  " to 1000");
      }
      count_ = static_cast<std::size_t>(*value);
    } else if (name == "Interval") {
      if (interval_) line.fail("is given twice; it may appear once");
      if (!value || !(*value > 0.0) || *value > kMostSizeMm) {
        line.fail("is " + in_quotes(word) + "; must be a number of mm above 0 and up to " + number_text(kMostSizeMm));
      }
      interval_ = *value;
    }
  }

  const std::string& file_;
  RowOrder rows_;
  bool in_properties_ = false;
  std::optional<std::size_t> count_;
  std::optional<double> interval_;
  std::optional<GridReader> grid_;
};

}  // namespace
}  // namespace io

SagFile parse_hmf(std::string_view text, const std::string& file, const SagReading& reading) {
  io::HmfReader reader(file, reading.rows);
  io::for_each_line(text, [&](std::size_t number, std::string_view line) { reader.take(number, line); });
  return reader.finish();
}

std::string to_hmf(const SagGrid& grid, const SagWriting& writing) {
  if (grid.columns != grid.rows || std::abs(grid.width - grid.height) > 1e-9) {
    throw std::invalid_argument("an HMF table is square, with as many columns as rows");
  }
  std::string text = "File Version=1.2\r\n[Properties]\r\nCount=" + std::to_string(grid.columns) + "\r\nInterval=" +
                     io::number_text(io::rounded(1e3 * grid.width / static_cast<double>(grid.columns - 1), 12)) +
                     "\r\n[Data]\r\n";
  for (const std::string& row : io::grid_rows(grid, writing, ',')) text += row + "\r\n";
  return text;
}

}  // namespace lenses
