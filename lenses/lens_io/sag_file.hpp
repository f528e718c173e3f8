// Files of tabulated surfaces: SDF, HMF and XYZ. They hold millimetres, with x to the right of the viewer who faces the
// wearer; here x is the wearer's, so a reader and a writer mirror it. Heights keep their sign: positive toward the eye.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lenses/lens.hpp"
#include "lenses/sag_samples.hpp"
#include "lenses/spline_fit.hpp"

namespace lenses {

enum class SagFormat { sdf, hmf, xyz };
// Programs disagree on which row of a table comes first: that of the greatest y, or of the least.
enum class RowOrder { top_first, bottom_first };

struct SagReading {
  RowOrder rows = RowOrder::top_first;
  // Which surface to take from an SDF file that holds several.
  std::optional<Side> side = {};
  std::optional<Face> face = {};
};

struct SagFile {
  std::optional<Side> side;  // what the file itself says: SDF only
  std::optional<Face> face;
  SagSamples samples;
};

// Heights on a grid that is centred on the lens axis, in lens axes; NaN where there is no surface.
struct SagGrid {
  std::size_t columns = 0, rows = 0;  // along x and y, at least 2
  double width = 0.0, height = 0.0;   // m, from the first to the last
  std::vector<double> sag;            // m, [i * rows + j] at x = -width/2 + i * step, y = -height/2 + j * step
  [[nodiscard]] double x(std::size_t i) const {
    return width * (static_cast<double>(i) / static_cast<double>(columns - 1) - 0.5);
  }
  [[nodiscard]] double y(std::size_t j) const {
    return height * (static_cast<double>(j) / static_cast<double>(rows - 1) - 0.5);
  }
};

struct SagWriting {
  RowOrder rows = RowOrder::top_first;
  Side side = Side::right;
  Face face = Face::front;
  int decimals = 6;  // of a millimetre
};

// Strict: whatever is not understood is a tracking::InputError with the file, the line and what is allowed.
[[nodiscard]] SagFile parse_sdf(std::string_view text, const std::string& file, const SagReading& reading = {});
[[nodiscard]] SagFile parse_hmf(std::string_view text, const std::string& file, const SagReading& reading = {});
[[nodiscard]] SagFile parse_xyz(std::string_view text, const std::string& file);
[[nodiscard]] SagFile parse_sag(SagFormat format, std::string_view text, const std::string& file,
                                const SagReading& reading = {});
// .hmf, .xyz, .sdf and, as they may hold SDF's records, .oma .vca .lds .lms; nullopt for any other ending.
[[nodiscard]] std::optional<SagFormat> sag_format_of(const std::string& path);
// With an InputError that lists the endings when the format is to follow from the name and does not.
[[nodiscard]] SagFile read_sag_file(const std::string& path, const SagReading& reading = {},
                                    std::optional<SagFormat> format = std::nullopt);

// fit_spline with what it throws as the file's InputError.
[[nodiscard]] SplineFit fit_sag_file(const SagFile& sag, const std::string& file, const SplineFitConfig& config = {});

// HMF tables are square: std::invalid_argument otherwise, and where a height is infinite.
[[nodiscard]] std::string to_sdf(const SagGrid& grid, const SagWriting& writing);
[[nodiscard]] std::string to_hmf(const SagGrid& grid, const SagWriting& writing);
[[nodiscard]] std::string to_xyz(const SagGrid& grid, const SagWriting& writing);
[[nodiscard]] std::string to_sag(SagFormat format, const SagGrid& grid, const SagWriting& writing);

}  // namespace lenses
