// The pupil's diameter in time: after a latency it follows the diameter that light and age call for
// (lenses/pupil.hpp), faster when it constricts than when it dilates.
#pragma once

#include "tracking/delayed_response.hpp"
#include "tracking/live_config.hpp"

namespace tracking {

class PupilResponse {
 public:
  // At rest at a diameter, m.
  PupilResponse(const PupilConfig& config, double diameter)
      : response_({config.latency, config.dilation_time_constant, config.constriction_time_constant}, diameter) {}

  // The diameter (m) at `time`, when light begins to call for `settled` (m).
  double step(double time, double settled) { return response_.step(time, settled); }

  [[nodiscard]] double diameter() const { return response_.value(); }

 private:
  DelayedResponse response_;
};

}  // namespace tracking
