// A recorded gaze played back: pure, the clock is the caller's.
#pragma once

#include <string>
#include <vector>

#include "xr/layer/gaze_source.hpp"

namespace xr::layer {

struct GazeRow {
  double time = 0.0;                                                                            // s
  std::array<glm::dvec3, 2> direction{glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 0.0, -1.0)};  // head axes, by Side
  bool valid = false;
};

// What follows the last row: it goes on counting as freshly sampled, the recording begins again, or the gaze is lost.
enum class AtEnd { hold, loop, stop };

class RecordedGaze : public GazeSource {
 public:
  // rows: at least one, times not decreasing.
  RecordedGaze(std::vector<GazeRow> rows, AtEnd at_end);

  [[nodiscard]] bool present() const override { return true; }
  // As a tracker without prediction answers: the last row not later than the time asked for, at that row's own time.
  [[nodiscard]] GazeReading at(XrTime time, XrTime start) const override;

 private:
  std::vector<GazeRow> rows_;
  AtEnd at_end_;
  double period_;  // of the loop, s
};

}  // namespace xr::layer
