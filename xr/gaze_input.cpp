#include "xr/gaze_input.hpp"

#include "xr/convert.hpp"

namespace xr {
namespace {

using tracking::GazeSample;
using tracking::Side;

constexpr glm::dvec3 kAhead(0.0, 0.0, -1.0);
constexpr float kLeastConfidence = 0.5F;  // of 1; below it the runtime rather guesses

constexpr std::size_t index_of(Side side) {
  return static_cast<std::size_t>(side);
}

}  // namespace

std::vector<std::string> gaze_extensions() {
  return {XR_FB_EYE_TRACKING_SOCIAL_EXTENSION_NAME, XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME};
}

GazeSupport gaze_support(const Instance& instance) {
  XrSystemEyeTrackingPropertiesFB eyes{};
  eyes.type = XR_TYPE_SYSTEM_EYE_TRACKING_PROPERTIES_FB;
  XrSystemEyeGazeInteractionPropertiesEXT combined{};
  combined.type = XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT;
  XrSystemProperties properties{};
  if (instance.has(XR_FB_EYE_TRACKING_SOCIAL_EXTENSION_NAME)) {
    properties.next = &eyes;
  }
  if (instance.has(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME)) {
    combined.next = properties.next;
    properties.next = &combined;
  }
  instance.get_properties(properties);
  return {.per_eye = eyes.supportsEyeTracking != XR_FALSE, .combined = combined.supportsEyeGazeInteraction != XR_FALSE};
}

GazeActions::GazeActions(const Instance& instance, ActionBindings& bindings) : support_(gaze_support(instance)) {
  if (!support_.combined) {
    return;
  }
  set_ = std::make_unique<ActionSet>(instance, "gaze", "Gaze");
  pose_ = set_->add_action(XR_ACTION_TYPE_POSE_INPUT, "gaze", "Where the eyes look");
  bindings.add_set(*set_);
  bindings.suggest("/interaction_profiles/ext/eye_gaze_interaction", pose_, "/user/eyes_ext/input/gaze_ext/pose");
}

GazeInput::GazeInput(const GazeActions& actions, const Session& session) : session_(session), pose_(actions.pose()) {
  const Instance& instance = session.instance();
  if (actions.support().per_eye) {
    destroy_tracker_ = instance.function<PFN_xrDestroyEyeTrackerFB>("xrDestroyEyeTrackerFB");
    get_eye_gazes_ = instance.function<PFN_xrGetEyeGazesFB>("xrGetEyeGazesFB");
    XrEyeTrackerCreateInfoFB info{};
    info.type = XR_TYPE_EYE_TRACKER_CREATE_INFO_FB;
    const auto create = instance.function<PFN_xrCreateEyeTrackerFB>("xrCreateEyeTrackerFB");
    const XrResult result = create(session.handle(), &info, &tracker_);
    if (result == XR_ERROR_INSTANCE_LOST || result == XR_ERROR_SESSION_LOST) {
      check(result, "xrCreateEyeTrackerFB");
    }
    if (XR_FAILED(result)) {
      tracker_ = XR_NULL_HANDLE;  // the user may have denied it; one line for both, or the head, then
    }
  }
  if (actions.support().combined) {
    XrActionSpaceCreateInfo info{};
    info.type = XR_TYPE_ACTION_SPACE_CREATE_INFO;
    info.action = pose_;
    info.poseInActionSpace = kIdentityPose;
    const XrResult result = xrCreateActionSpace(session.handle(), &info, &gaze_space_);
    if (XR_FAILED(result) && tracker_ != XR_NULL_HANDLE) {
      destroy_tracker_(tracker_);
    }
    check(result, "xrCreateActionSpace");
  }
}

GazeInput::~GazeInput() {
  if (gaze_space_ != XR_NULL_HANDLE) {
    xrDestroySpace(gaze_space_);
  }
  if (tracker_ != XR_NULL_HANDLE) {
    destroy_tracker_(tracker_);
  }
}

std::optional<GazeSample> GazeInput::read(const Space& view, XrTime display_time) const {
  if (gaze_space_ == XR_NULL_HANDLE && tracker_ == XR_NULL_HANDLE) {
    return std::nullopt;
  }
  GazeSample sample;
  if (session_.is_focused() && display_time > 0) {
    if (tracker_ != XR_NULL_HANDLE) {
      read_eyes(view, display_time, sample);
    }
    const bool both = sample.eye[0] && sample.eye[1];
    if (!both && gaze_space_ != XR_NULL_HANDLE && is_active()) {
      read_combined(view, display_time, sample);
    }
  }
  sample.valid = sample.combined || sample.eye[0] || sample.eye[1];
  return sample;
}

void GazeInput::read_eyes(const Space& view, XrTime display_time, GazeSample& sample) const {
  XrEyeGazesInfoFB info{};
  info.type = XR_TYPE_EYE_GAZES_INFO_FB;
  info.baseSpace = view.handle();
  info.time = display_time;
  XrEyeGazesFB gazes{};
  gazes.type = XR_TYPE_EYE_GAZES_FB;
  check(get_eye_gazes_(tracker_, &info, &gazes), "xrGetEyeGazesFB");
  for (const Side side : {Side::right, Side::left}) {
    const XrEyeGazeFB& gaze = gazes.gaze[side == Side::left ? XR_EYE_POSITION_LEFT_FB : XR_EYE_POSITION_RIGHT_FB];
    if (gaze.isValid != XR_FALSE && gaze.gazeConfidence >= kLeastConfidence) {
      sample.eye[index_of(side)] = pose_of(gaze.gazePose).direction(kAhead);
    }
  }
  if (gazes.time > 0) {
    sample.time = seconds(gazes.time);
  }
}

bool GazeInput::is_active() const {
  XrActionStateGetInfo info{};
  info.type = XR_TYPE_ACTION_STATE_GET_INFO;
  info.action = pose_;
  XrActionStatePose state{};
  state.type = XR_TYPE_ACTION_STATE_POSE;
  check(xrGetActionStatePose(session_.handle(), &info, &state), "xrGetActionStatePose");
  return state.isActive != XR_FALSE;
}

void GazeInput::read_combined(const Space& view, XrTime display_time, GazeSample& sample) const {
  constexpr XrSpaceLocationFlags kNeeded =
      XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT |
      XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
  XrEyeGazeSampleTimeEXT measured{};
  measured.type = XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT;
  XrSpaceLocation location{};
  location.type = XR_TYPE_SPACE_LOCATION;
  location.next = &measured;
  check(xrLocateSpace(gaze_space_, view.handle(), display_time, &location), "xrLocateSpace");
  if ((location.locationFlags & kNeeded) != kNeeded) {
    return;
  }
  const tracking::Pose head_from_gaze = pose_of(location.pose);
  sample.combined = tracking::Line{head_from_gaze.position, head_from_gaze.direction(kAhead)};
  if (measured.time > 0) {
    sample.time = seconds(measured.time);
  }
}

std::string_view source_name(const tracking::FollowedGaze& gaze) {
  switch (gaze.source) {
    case tracking::GazeSource::tracker:
      return gaze.two_lines ? "per-eye" : "combined";
    case tracking::GazeSource::held:
      return "held";
    case tracking::GazeSource::target:
      return "target";
    case tracking::GazeSource::head:
      break;
  }
  return "head";
}

}  // namespace xr
