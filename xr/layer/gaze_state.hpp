// What the layer knows at a moment: who answers for the gaze, and what it is.
#pragma once

#include "xr/layer/handles.hpp"

namespace xr::layer {

// The eye tracker of a layer whose settings cannot be used: there, and blind.
class NoGaze : public GazeSource {
 public:
  [[nodiscard]] bool present() const override { return false; }
  [[nodiscard]] GazeReading at(XrTime, XrTime) const override { return {}; }
};

struct GazeSupport {
  bool gaze_interaction = false, eye_tracking = false;
};

// What the runtime itself can do.
[[nodiscard]] GazeSupport runtime_support(const Instance& instance, XrSystemId system);

// Not valid unless the session has the focus.
[[nodiscard]] GazeReading gaze_at(Session& session, XrTime time);

// Whether the session has the focus and the source an eye tracker.
[[nodiscard]] bool tracker_present(Session& session);

// Whether the last xrSyncActions of a focused session took this action's gaze binding in.
[[nodiscard]] bool gaze_is_active(Session& session, const Action& action);

// The runtime's VIEW space, in which all gaze is known. Made on first use.
[[nodiscard]] XrSpace view_space(Session& session);

// Tells once per session that the eyes have an interaction profile.
XrResult take_profile_event(const Instance& instance, XrEventDataBuffer& event);

// Whether the session answers to the eye gaze profile at all.
[[nodiscard]] bool has_gaze_bindings(const Session& session);

}  // namespace xr::layer
