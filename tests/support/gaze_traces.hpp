// Gaze traces for the gaze layer, and the layer in this process's environment.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/vec3.hpp>
#include <string>

#include "tests/support/monado.hpp"
#include "tracking/stereo_view.hpp"
#include "xr/openxr_compat.hpp"

namespace support {

inline constexpr const char* kGazeLayer = "XR_APILAYER_VERGENCE_gaze";

// Loads the gaze layer, with nothing yet to give, and others above it (named before it) or below.
inline void enable_layers(const std::string& names) {
  for (const char* name : {"TRACE", "SOCKET", "END", "FORCE"}) {
    unsetenv((std::string("VERGENCE_GAZE_") + name).c_str());
  }
  setenv("XR_API_LAYER_PATH", VERGENCE_GAZE_LAYER ":/usr/share/openxr/1/api_layers/explicit.d", 1);
  setenv("XR_ENABLE_API_LAYERS", names.c_str(), 1);
}

inline constexpr const char* kGazeHeader =
    "time_s,head_px,head_py,head_pz,head_qx,head_qy,head_qz,head_qw,left_gx,left_gy,left_gz,right_gx,right_gy,right_gz,"
    "gaze_valid\n";

// A row of a trace; the head's own pose is the runtime's affair.
inline std::string gaze_row(double time, const glm::dvec3& left, const glm::dvec3& right, bool valid = true) {
  char text[512];
  std::snprintf(text, sizeof(text), "%.17g,0,0,0,0,0,0,1,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%d\n", time, left.x,
                left.y, left.z, right.x, right.y, right.z, valid ? 1 : 0);
  return text;
}

// A file that is gone with the test.
class TraceFile {
 public:
  TraceFile(const Monado& monado, const std::string& rows) : path_(monado.folder() / "trace.csv") {
    std::ofstream(path_) << kGazeHeader << rows;
    setenv("VERGENCE_GAZE_TRACE", path_.c_str(), 1);
  }

 private:
  std::filesystem::path path_;
};

// A direction by angles in degrees, right and up.
inline glm::dvec3 yaw(double degrees, double pitch_degrees = 0.0) {
  constexpr double kDegree = 0.017453292519943295;
  return tracking::direction_from_yaw_pitch(degrees * kDegree, pitch_degrees * kDegree);
}

constexpr XrTime nanoseconds(double seconds) {
  return static_cast<XrTime>(seconds * 1e9);
}

// A float quaternion's own error, with some to spare for a runtime's sums in float.
inline constexpr double kFloatPose = 2e-6;

}  // namespace support
