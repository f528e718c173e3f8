#include "lenses/lens_io/file_surface_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "lenses/lens_io/placement_reader.hpp"
#include "lenses/lens_io/sag_file.hpp"
#include "tracking/input_error.hpp"

namespace lenses::io {
namespace {

namespace fs = std::filesystem;

// A lens file from a stranger must not reach for other files than those it came with.
fs::path path_in_folder(const Field& field) {
  const std::string expected = "a path of a .sdf, .hmf, .xyz, .oma, .vca, .lds or .lms file";
  const std::string& name = field.text(expected);
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (name.empty() || std::ranges::any_of(name, is_control)) field.fail_type(expected);
  const fs::path path(name);
  const fs::path parent = fs::path(field.file()).parent_path();
  const fs::path folder = parent.empty() ? fs::path(".") : parent;
  std::error_code error;
  const fs::path real = fs::weakly_canonical(folder / path, error);
  const fs::path relative = error ? fs::path() : real.lexically_relative(fs::weakly_canonical(folder, error));
  const bool climbs = std::ranges::any_of(path, [](const fs::path& part) { return part == ".."; });
  if (error || path.is_absolute() || climbs || relative.empty() || *relative.begin() == "..") {
    field.fail("leaves the folder of this file; a path inside of it, without .., is allowed");
  }
  if (!fs::is_regular_file(real, error)) field.fail_type(expected + " beside this one; there is no such file");
  return folder / path;
}

}  // namespace

BsplineHeightField read_file_surface(const Field& surface) {
  surface.allow_only({"type", "path", "rows", "side", "surface", "smoothing_um"}, kPlacementKeys);
  SagReading reading;
  if (const auto rows = surface.find("rows")) {
    reading.rows = rows->choice<RowOrder>({{"top", RowOrder::top_first}, {"bottom", RowOrder::bottom_first}});
  }
  if (const auto side = surface.find("side")) {
    reading.side = side->choice<Side>({{"right", Side::right}, {"left", Side::left}});
  }
  if (const auto face = surface.find("surface")) {
    reading.face = face->choice<Face>({{"front", Face::front}, {"back", Face::back}});
  }
  SplineFitConfig config;
  surface.read("smoothing_um", micrometres(0.0, 100.0), config.noise);
  const Field path = surface.require("path", "the path of a tabulated surface");
  const std::string file = path_in_folder(path).string();
  try {
    return fit_sag_file(read_sag_file(file, reading), file, config).surface;
  } catch (const tracking::InputError& error) {
    path.fail(error.what());
  }
}

}  // namespace lenses::io
