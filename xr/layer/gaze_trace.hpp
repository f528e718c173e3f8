// The rows of a recorded trace, from its file.
#pragma once

#include <string>
#include <vector>

#include "xr/layer/recorded_gaze.hpp"

namespace xr::layer {

// Throws tracking::InputError{file, line, reason}; never waits for something that is no file.
[[nodiscard]] std::vector<GazeRow> read_gaze_trace(const std::string& path);

}  // namespace xr::layer
