// What the tabulated formats share: numbers with the precision they were written in, grids in either row order, text.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "lenses/lens_io/sag_file.hpp"

namespace lenses::io {

inline constexpr std::size_t kFewestPlaces = 4, kMostPlaces = 2001;  // of a grid, a direction
inline constexpr std::size_t kMostSamples = 1000000;
inline constexpr double kMostSizeMm = 500.0, kMostSagMm = 1000.0;

// A position in a text file, for the field of an InputError.
struct TextLine {
  const std::string& file;
  std::size_t number;      // from 1
  std::string_view label;  // empty: none
  [[noreturn]] void fail(const std::string& reason) const;
};

// A text line by line, whatever its line ends.
void for_each_line(std::string_view text, const std::function<void(std::size_t number, std::string_view line)>& take);

// Numbers as they are read, to learn from their digits how they were rounded. A program writes either so many decimals
// or so many significant digits; the most of each that occur tell which.
class WrittenDigits {
 public:
  void see(std::string_view text, double value);
  // Root mean square of the rounding errors: a step / sqrt(12) a number, in the numbers' unit.
  [[nodiscard]] double noise() const;

 private:
  std::vector<int> exponents_;  // decimal, of the values that are not 0
  std::size_t zeros_ = 0;
  int most_decimals_ = 0, most_significant_ = 1;
};

// A height in millimetres; "?" is one that is not there (nullopt).
[[nodiscard]] std::optional<double> sag_in(std::string_view text, const TextLine& line, std::size_t entry,
                                           WrittenDigits& digits);

// Rows of a table, as they come, into samples on a grid centred on the lens axis.
class GridReader {
 public:
  GridReader(std::size_t columns, std::size_t rows, double width_mm, double height_mm, RowOrder order);
  void take_row(std::string_view text, char separator, const TextLine& line);
  [[nodiscard]] std::size_t rows_taken() const { return rows_taken_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] SagSamples finish();  // all rows must have been taken

 private:
  std::size_t columns_, rows_, rows_taken_ = 0;
  double width_, height_;  // mm
  RowOrder order_;
  WrittenDigits digits_;
  SagSamples samples_;
};

// The grid's rows in the file's order, columns from the viewer's left, fixed decimals of a millimetre.
[[nodiscard]] std::vector<std::string> grid_rows(const SagGrid& grid, const SagWriting& writing, char separator);
[[nodiscard]] std::string fixed_text(double value, int decimals);
void check_grid(const SagGrid& grid);  // std::invalid_argument

}  // namespace lenses::io
