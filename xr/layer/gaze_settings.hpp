// What the environment tells the layer: where gaze comes from, and whether to give it even where the runtime has its
// own.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "xr/layer/recorded_gaze.hpp"

namespace xr::layer {

struct GazeSettings {
  std::string trace;           // VERGENCE_GAZE_TRACE: a file
  std::string socket;          // VERGENCE_GAZE_SOCKET: a local socket that somebody listens on
  AtEnd at_end = AtEnd::hold;  // VERGENCE_GAZE_END: hold, loop or stop
  bool force = false;          // VERGENCE_GAZE_FORCE=1
};

// Throws tracking::InputError.
[[nodiscard]] GazeSettings settings_from_environment();

// The source so described; null where none is. Throws tracking::InputError.
[[nodiscard]] std::unique_ptr<GazeSource> open_source(const GazeSettings& settings,
                                                      std::function<std::optional<XrTime>(double)> time_of_monotonic);

// One line on stderr: an API layer has no other way to reach the user.
void report_problem(const std::string& text);

}  // namespace xr::layer
