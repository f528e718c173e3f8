// XYZ, a point a line: x y z in millimetres, set apart by spaces, tabs, commas or semicolons; # begins a comment.
#include <array>
#include <cmath>

#include "lenses/lens_io/json_document.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/oma_job.hpp"
#include "lenses/lens_io/sag_text.hpp"
#include "lenses/lens_io/units.hpp"
#include "tracking/input_error.hpp"

namespace lenses {
namespace io {
namespace {

constexpr std::string_view kSeparators = " \t,;";

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t start = line.find_first_not_of(kSeparators);
    if (start == std::string_view::npos) return words;
    line.remove_prefix(start);
    const std::size_t end = std::min(line.find_first_of(kSeparators), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

double coordinate_in(std::string_view word, const TextLine& line, const char* name) {
  const auto value = number_in(word);
  if (!value || std::abs(*value) > kMostSizeMm) {
    line.fail(std::string(name) + " is " + in_quotes(word) + "; must be a number from " + number_text(-kMostSizeMm) +
              " to " + number_text(kMostSizeMm));
  }
  return *value;
}

}  // namespace
}  // namespace io

SagFile parse_xyz(std::string_view text, const std::string& file) {
  SagFile result;
  io::WrittenDigits digits;
  io::for_each_line(text, [&](std::size_t number, std::string_view content) {
    const io::TextLine line{file, number, {}};
    const std::vector<std::string_view> words = io::words_of(content.substr(0, content.find('#')));
    if (words.empty()) return;
    if (words.size() != 3) line.fail("has " + std::to_string(words.size()) + " numbers; must be x y z in mm");
    if (result.samples.points.size() == io::kMostSamples) {
      line.fail("is a point too many; up to " + std::to_string(io::kMostSamples) + " are allowed");
    }
    const double x = io::coordinate_in(words[0], line, "x"), y = io::coordinate_in(words[1], line, "y");
    if (const auto z = io::sag_in(words[2], line, 2, digits)) {
      result.samples.points.emplace_back(io::from_mm(-x), io::from_mm(y), io::from_mm(*z));
    }
  });
  result.samples.noise = io::from_mm(digits.noise());
  return result;
}

std::string to_xyz(const SagGrid& grid, const SagWriting& writing) {
  io::check_grid(grid);
  std::string text;
  for (std::size_t r = 0; r < grid.rows; ++r) {
    const std::size_t j = writing.rows == RowOrder::top_first ? grid.rows - 1 - r : r;
    for (std::size_t k = 0; k < grid.columns; ++k) {
      const std::size_t i = grid.columns - 1 - k;
      if (std::isnan(grid.sag[i * grid.rows + j])) continue;
      text += io::number_text(io::rounded(-1e3 * grid.x(i), 12)) + " " +
              io::number_text(io::rounded(1e3 * grid.y(j), 12)) + " " +
              io::fixed_text(1e3 * grid.sag[i * grid.rows + j], writing.decimals) + "\r\n";
    }
  }
  return text;
}

}  // namespace lenses
