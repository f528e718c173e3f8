// XR_FB_eye_tracking_social: a pose for each eye.
#include <atomic>

#include "xr/convert.hpp"
#include "xr/layer/entry_points.hpp"
#include "xr/layer/gaze_poses.hpp"
#include "xr/layer/gaze_state.hpp"
#include "xr/layer/handles.hpp"

namespace xr::layer {
namespace {

// Trackers of ours have numbers that are never used again, so that a stale handle is known for one. A runtime's are
// addresses and lie higher.
XrEyeTrackerFB new_handle() {
  static std::atomic<std::uintptr_t> last = 0;
  return reinterpret_cast<XrEyeTrackerFB>(++last);
}

XrResult needs(const void* structure, XrStructureType type) {
  return structure && static_cast<const XrBaseInStructure*>(structure)->type == type ? XR_SUCCESS
                                                                                     : XR_ERROR_VALIDATION_FAILURE;
}

XrEyeGazeFB eye_gaze(tracking::Side side, const GazeReading& reading, const tracking::Pose& base_from_head) {
  return {XR_TRUE, to_xr(base_from_head * eye_pose(side, reading.direction)), 1.0F};
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL create_eye_tracker(XrSession handle, const XrEyeTrackerCreateInfoFB* info,
                                                  XrEyeTrackerFB* tracker) noexcept {
  return guarded([&] {
    const auto session = handles().sessions.get(handle);
    if (!session->gives_eyes) {
      const auto next = session->instance->next.xrCreateEyeTrackerFB;
      return next ? next(handle, info, tracker) : XR_ERROR_FEATURE_UNSUPPORTED;
    }
    check(needs(info, XR_TYPE_EYE_TRACKER_CREATE_INFO_FB));
    if (!tracker) {
      return XR_ERROR_VALIDATION_FAILURE;
    }
    auto made = std::make_shared<EyeTracker>();
    made->session = session;
    *tracker = new_handle();
    handles().eye_trackers.add(*tracker, std::move(made));
    return XR_SUCCESS;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL destroy_eye_tracker(XrEyeTrackerFB handle) noexcept {
  return guarded([&] {
    if (handles().eye_trackers.erase(handle)) {
      return XR_SUCCESS;
    }
    const auto all = handles().instances.all();
    const auto next = all.size() == 1 ? all.front()->next.xrDestroyEyeTrackerFB : nullptr;
    return next ? next(handle) : XR_ERROR_HANDLE_INVALID;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL get_eye_gazes(XrEyeTrackerFB handle, const XrEyeGazesInfoFB* info,
                                             XrEyeGazesFB* gazes) noexcept {
  return guarded([&] {
    const auto tracker = handles().eye_trackers.find(handle);
    if (!tracker) {
      const auto all = handles().instances.all();
      const auto next = all.size() == 1 ? all.front()->next.xrGetEyeGazesFB : nullptr;
      return next ? next(handle, info, gazes) : XR_ERROR_HANDLE_INVALID;
    }
    check(needs(info, XR_TYPE_EYE_GAZES_INFO_FB));
    check(needs(gazes, XR_TYPE_EYE_GAZES_FB));
    Session& session = *tracker->session;
    XrSpaceLocation head{};
    head.type = XR_TYPE_SPACE_LOCATION;
    check(locate_space(view_space(session), info->baseSpace, info->time, &head));
    const GazeReading reading = gaze_at(session, info->time);
    gazes->gaze[XR_EYE_POSITION_LEFT_FB] = gazes->gaze[XR_EYE_POSITION_RIGHT_FB] = {XR_FALSE, kIdentityPose, 0.0F};
    gazes->time = info->time;
    if (reading.valid && gaze_flags(head.locationFlags) != 0) {
      const tracking::Pose base_from_head = pose_of(head.pose);
      gazes->gaze[XR_EYE_POSITION_LEFT_FB] = eye_gaze(tracking::Side::left, reading, base_from_head);
      gazes->gaze[XR_EYE_POSITION_RIGHT_FB] = eye_gaze(tracking::Side::right, reading, base_from_head);
      gazes->time = reading.sample_time;
    }
    return XR_SUCCESS;
  });
}

}  // namespace xr::layer
