#include "lenses/lens_io/sag_file.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "lenses/lens_io/json_document.hpp"
#include "tracking/input_error.hpp"

namespace lenses {

SagFile parse_sag(SagFormat format, std::string_view text, const std::string& file, const SagReading& reading) {
  switch (format) {
    case SagFormat::sdf:
      return parse_sdf(text, file, reading);
    case SagFormat::hmf:
      return parse_hmf(text, file, reading);
    case SagFormat::xyz:
      return parse_xyz(text, file);
  }
  throw std::invalid_argument("no such format");
}

std::optional<SagFormat> sag_format_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".hmf") return SagFormat::hmf;
  if (ending == ".xyz") return SagFormat::xyz;
  for (const char* sdf : {".sdf", ".oma", ".vca", ".lds", ".lms"}) {
    if (ending == sdf) return SagFormat::sdf;
  }
  return std::nullopt;
}

SagFile read_sag_file(const std::string& path, const SagReading& reading, std::optional<SagFormat> format) {
  if (!format) format = sag_format_of(path);
  if (!format) {
    throw tracking::InputError(path, "",
                               "is of no format that its name tells; .sdf .hmf .xyz .oma .vca .lds .lms are read");
  }
  return parse_sag(*format, io::read_text_file(path), path, reading);
}

SplineFit fit_sag_file(const SagFile& sag, const std::string& file, const SplineFitConfig& config) {
  try {
    return fit_spline(sag.samples, config);
  } catch (const std::invalid_argument& error) {
    throw tracking::InputError(file, "", std::string("defines no surface: ") + error.what());
  }
}

std::string to_sag(SagFormat format, const SagGrid& grid, const SagWriting& writing) {
  switch (format) {
    case SagFormat::sdf:
      return to_sdf(grid, writing);
    case SagFormat::hmf:
      return to_hmf(grid, writing);
    case SagFormat::xyz:
      return to_xyz(grid, writing);
  }
  throw std::invalid_argument("no such format");
}

}  // namespace lenses
