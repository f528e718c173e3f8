#include "tracking/live_state.hpp"

#include <cmath>
#include <limits>

namespace tracking {
namespace {

double dioptres(double distance) {
  return distance > 0.0 ? 1.0 / distance : 0.0;
}

}  // namespace

LiveState::LiveState(const LiveConfig& config, const Wearer& wearer)
    : follower_(config.gaze),
      depth_(config.gaze.depth_dwell),
      accommodation_(config.accommodation, wearer.amplitude),
      pupil_{PupilResponse(config.pupil, wearer.pupil_diameter[0]),
             PupilResponse(config.pupil, wearer.pupil_diameter[1])} {
  state_.pupil_diameter = wearer.pupil_diameter;
  state_.age = std::numeric_limits<double>::infinity();
}

const EyeState& LiveState::step(const Frame& frame, const Look& look) {
  if (!std::isfinite(frame.time) || (time_ && frame.time < *time_)) {
    return state_;
  }
  time_ = frame.time;
  const FollowedGaze gaze = follower_.step(frame.time, frame.world_from_head, frame.sample);
  // First what the eyes look at, then how far they turn for it: the second with a depth that does not flicker.
  LookRequest request{frame.world_from_head, gaze.two_lines, gaze.origin, gaze.target, std::nullopt};
  const LookedAt seen = look(request);
  const double depth = depth_.see(frame.time, dioptres(seen.distance), gaze.jumped);
  request.gaze = gaze.pupil;
  request.distance = depth > 0.0 ? 1.0 / depth : std::numeric_limits<double>::infinity();
  const LookedAt held = look(request);
  state_.gaze = held.gaze;
  state_.target = seen.gaze;
  state_.distance = *request.distance;
  state_.demand = held.demand;
  state_.accommodation = accommodation_.step(frame.time, held.demand);
  for (std::size_t i = 0; i < 2; ++i) {
    state_.pupil_diameter[i] = pupil_[i].step(frame.time, frame.settled_pupil[i]);
  }
  state_.source = gaze.source;
  state_.phase = gaze.phase;
  state_.age = gaze.age;
  state_.request = request;
  return state_;
}

}  // namespace tracking
