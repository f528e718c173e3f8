#include "xr/layer/gaze_trace.hpp"

#include <filesystem>
#include <fstream>

#include "tracking/input_error.hpp"
#include "xr/layer/gaze_line.hpp"

namespace xr::layer {

std::vector<GazeRow> read_gaze_trace(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw tracking::InputError(path, "", "is no file");
  }
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || !line.starts_with(kGazeHeader)) {
    throw tracking::InputError(path, "line 1", "the header is missing; it is " + std::string(kGazeHeader));
  }
  std::vector<GazeRow> rows;
  for (std::size_t number = 2; std::getline(file, line); ++number) {
    if (line.empty() || line == "\r") {
      continue;
    }
    const auto parsed = parse_gaze_line(line);
    if (const auto* reason = std::get_if<std::string>(&parsed)) {
      throw tracking::InputError(path, "line " + std::to_string(number), *reason);
    }
    rows.push_back(std::get<GazeRow>(parsed));
    if (rows.size() > 1 && rows.back().time < rows[rows.size() - 2].time) {
      throw tracking::InputError(path, "line " + std::to_string(number), "time_s goes back; it may only grow");
    }
  }
  if (rows.empty()) {
    throw tracking::InputError(path, "", "has no rows");
  }
  return rows;
}

}  // namespace xr::layer
