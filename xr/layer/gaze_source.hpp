// Where the layer's gaze comes from, as a runtime would hear of it from an eye tracker: what the eyes did when they
// were last seen, and when that was.
#pragma once

#include "xr/openxr_compat.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "tracking/stereo_view.hpp"

namespace xr::layer {

struct GazeReading {
  bool valid = false;  // both eyes were seen; false in a blink or where the tracker lost them
  std::array<glm::dvec3, 2> direction{glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 0.0, -1.0)};  // head axes, by Side
  XrTime sample_time = 0;  // when the eyes looked so; 0: not known
};

class GazeSource {
 public:
  virtual ~GazeSource() = default;
  // Whether there is an eye tracker behind it, whatever it sees.
  [[nodiscard]] virtual bool present() const = 0;
  // What is known of the gaze at `time`; never waits. `start` is the first time a session asked for, where a recording
  // begins.
  [[nodiscard]] virtual GazeReading at(XrTime time, XrTime start) const = 0;
};

}  // namespace xr::layer
