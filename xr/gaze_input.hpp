// The wearer's gaze as the runtime knows it: each eye's own (XR_FB_eye_tracking_social) where that is offered, else one
// line for both (XR_EXT_eye_gaze_interaction), in the head's axes. What lies between two samples, blinks and losses are
// tracking::GazeFollower's affair.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tracking/gaze_follower.hpp"
#include "xr/actions.hpp"
#include "xr/spaces.hpp"

namespace xr {

// To be asked of an Instance.
[[nodiscard]] std::vector<std::string> gaze_extensions();

// What the headset of an instance can do.
struct GazeSupport {
  bool per_eye = false, combined = false;
};
[[nodiscard]] GazeSupport gaze_support(const Instance& instance);

// Before action sets are attached: the gaze's own set, and its binding.
class GazeActions {
 public:
  // Without eye tracking nothing is added to the bindings.
  GazeActions(const Instance& instance, ActionBindings& bindings);

  [[nodiscard]] const GazeSupport& support() const { return support_; }
  [[nodiscard]] XrAction pose() const { return pose_; }

 private:
  GazeSupport support_;
  std::unique_ptr<ActionSet> set_;
  XrAction pose_ = XR_NULL_HANDLE;
};

// After they are attached.
class GazeInput {
 public:
  // Refers to the session; the actions must outlive this.
  GazeInput(const GazeActions& actions, const Session& session);
  ~GazeInput();
  GazeInput(const GazeInput&) = delete;
  GazeInput& operator=(const GazeInput&) = delete;

  // What the tracker knows at the time a frame will be seen; nothing: there is no eye tracker. Only what is both active
  // and tracked counts, else the sample is not valid. Times are OpenXR's in seconds. Wants the actions to be synced.
  [[nodiscard]] std::optional<tracking::GazeSample> read(const Space& view, XrTime display_time) const;

 private:
  void read_eyes(const Space& view, XrTime display_time, tracking::GazeSample& sample) const;
  void read_combined(const Space& view, XrTime display_time, tracking::GazeSample& sample) const;
  [[nodiscard]] bool is_active() const;

  const Session& session_;
  XrAction pose_;
  XrSpace gaze_space_ = XR_NULL_HANDLE;      // null: no combined gaze
  XrEyeTrackerFB tracker_ = XR_NULL_HANDLE;  // null: no eyes of their own
  PFN_xrDestroyEyeTrackerFB destroy_tracker_ = nullptr;
  PFN_xrGetEyeGazesFB get_eye_gazes_ = nullptr;
};

[[nodiscard]] constexpr double seconds(XrTime time) {
  return static_cast<double>(time) * 1e-9;
}

// Whose gaze a picture is drawn for, as the user is told: "per-eye", "combined", "held", "target", "head".
[[nodiscard]] std::string_view source_name(const tracking::FollowedGaze& gaze);

}  // namespace xr
