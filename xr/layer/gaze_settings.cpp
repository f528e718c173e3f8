#include "xr/layer/gaze_settings.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "tracking/input_error.hpp"
#include "xr/layer/socket_gaze.hpp"

namespace xr::layer {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

AtEnd at_end_from(const std::string& text) {
  if (text.empty() || text == "hold") {
    return AtEnd::hold;
  }
  if (text == "loop") {
    return AtEnd::loop;
  }
  if (text == "stop") {
    return AtEnd::stop;
  }
  throw tracking::InputError("VERGENCE_GAZE_END", "", "'" + text + "' is not one of hold, loop, stop");
}

bool flag_from(const char* name) {
  const std::string text = variable(name);
  if (!text.empty() && text != "0" && text != "1") {
    throw tracking::InputError(name, "", "'" + text + "' is neither 0 nor 1");
  }
  return text == "1";
}

}  // namespace

GazeSettings settings_from_environment() {
  GazeSettings settings{.trace = variable("VERGENCE_GAZE_TRACE"),
                        .socket = variable("VERGENCE_GAZE_SOCKET"),
                        .at_end = at_end_from(variable("VERGENCE_GAZE_END")),
                        .force = flag_from("VERGENCE_GAZE_FORCE")};
  if (!settings.trace.empty() && !settings.socket.empty()) {
    throw tracking::InputError("VERGENCE_GAZE_SOCKET", "", "VERGENCE_GAZE_TRACE is set too; one of them is allowed");
  }
  return settings;
}

std::unique_ptr<GazeSource> open_source(const GazeSettings& settings,
                                        std::function<std::optional<XrTime>(double)> time_of_monotonic) {
  if (!settings.trace.empty()) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(settings.trace, error)) {  // of which some would keep the program waiting
      throw tracking::InputError(settings.trace, "", "is no file; VERGENCE_GAZE_TRACE names a recorded trace");
    }
    return std::make_unique<RecordedGaze>(tracking::read_gaze_trace(settings.trace), settings.at_end);
  }
  if (!settings.socket.empty()) {
    SocketGaze::Config config;
    config.path = settings.socket;
    config.time_of_monotonic = std::move(time_of_monotonic);
    config.report = report_problem;
    return std::make_unique<SocketGaze>(std::move(config));
  }
  return nullptr;
}

void report_problem(const std::string& text) {
  std::fprintf(stderr, "XR_APILAYER_VERGENCE_gaze: %s\n", text.c_str());
}

}  // namespace xr::layer
