// A recorded gaze played back: pure, the clock is the caller's.
#pragma once

#include <vector>

#include "tracking/gaze_trace.hpp"
#include "xr/layer/gaze_source.hpp"

namespace xr::layer {

// What follows the last row: it goes on counting as freshly sampled, the recording begins again, or the gaze is lost.
enum class AtEnd { hold, loop, stop };

class RecordedGaze : public GazeSource {
 public:
  RecordedGaze(tracking::GazeTrace trace, AtEnd at_end);

  [[nodiscard]] bool present() const override { return true; }
  // As a tracker without prediction answers: the last row not later than the time asked for, at that row's own time.
  [[nodiscard]] GazeReading at(XrTime time, XrTime start) const override;

 private:
  std::vector<tracking::TraceRow> rows_;  // at least one, times increase
  AtEnd at_end_;
  double period_;  // s, from its beginning to its end
};

}  // namespace xr::layer
