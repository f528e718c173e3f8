// A program that wants gaze, as any would: both extensions by plain OpenXR calls, in a session without pictures.
#pragma once

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/gaze_traces.hpp"
#include "xr/actions.hpp"
#include "xr/convert.hpp"
#include "xr/session.hpp"
#include "xr/spaces.hpp"

namespace support {

class GazeProgram {
 public:
  GazeProgram()
      : instance(
            {.application = "gaze test",
             .wanted_extensions = {XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME, XR_FB_EYE_TRACKING_SOCIAL_EXTENSION_NAME,
                                   XR_MND_HEADLESS_EXTENSION_NAME, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME,
                                   XR_KHR_LOCATE_SPACES_EXTENSION_NAME}}),
        session(instance),
        view(session, XR_REFERENCE_SPACE_TYPE_VIEW),
        local(session, XR_REFERENCE_SPACE_TYPE_LOCAL),
        set(instance, "gaze", "Gaze"),
        pose(set.add_action(XR_ACTION_TYPE_POSE_INPUT, "gaze", "Gaze")),
        bindings(instance) {
    bindings.add_set(set);
    bindings.suggest("/interaction_profiles/ext/eye_gaze_interaction", pose, "/user/eyes_ext/input/gaze_ext/pose");
    bindings.attach(session);
    gaze_space = action_space(xr::kIdentityPose);
  }

  ~GazeProgram() { xrDestroySpace(gaze_space); }

  [[nodiscard]] XrSpace action_space(const XrPosef& offset) const {
    XrActionSpaceCreateInfo info{};
    info.type = XR_TYPE_ACTION_SPACE_CREATE_INFO;
    info.action = pose;
    info.poseInActionSpace = offset;
    XrSpace space = XR_NULL_HANDLE;
    xr::check(xrCreateActionSpace(session.handle(), &info, &space), "xrCreateActionSpace");
    return space;
  }

  void poll() {
    while (const auto event = instance.poll()) {
      session.handle(*event);
      events.push_back(event->type);
    }
  }

  void wait_for_focus() {
    for (int tries = 0; tries < 2000 && !session.is_focused(); ++tries) {  // 20 s
      poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (!session.is_focused()) {
      throw std::runtime_error("the session never got the focus");
    }
    bindings.sync(session);
  }

  [[nodiscard]] XrTime now() const {
    std::timespec moment{};
    clock_gettime(CLOCK_MONOTONIC, &moment);
    XrTime time = 0;
    xr::check(instance.function<PFN_xrConvertTimespecTimeToTimeKHR>("xrConvertTimespecTimeToTimeKHR")(instance.handle(),
                                                                                                      &moment, &time),
              "xrConvertTimespecTimeToTimeKHR");
    return time;
  }

  struct Located {
    XrSpaceLocationFlags flags = 0;
    tracking::Pose base_from_space;
    glm::dvec3 direction{0.0};
    XrTime sample_time = 0;
  };

  [[nodiscard]] Located locate(XrSpace space, XrSpace base, XrTime time) const {
    XrEyeGazeSampleTimeEXT sample{XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT, nullptr, -1};
    XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, &sample, 0, xr::kIdentityPose};
    xr::check(xrLocateSpace(space, base, time, &location), "xrLocateSpace");
    const tracking::Pose found = xr::pose_of(location.pose);
    return {location.locationFlags, found, found.direction({0.0, 0.0, -1.0}), sample.time};
  }
  [[nodiscard]] Located gaze(XrTime time) const { return locate(gaze_space, view.handle(), time); }

  [[nodiscard]] bool is_active() const {
    XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, pose, XR_NULL_PATH};
    XrActionStatePose state{XR_TYPE_ACTION_STATE_POSE, nullptr, XR_FALSE};
    xr::check(xrGetActionStatePose(session.handle(), &info, &state), "xrGetActionStatePose");
    return state.isActive != XR_FALSE;
  }

  xr::Instance instance;
  xr::Session session;
  xr::Space view, local;
  xr::ActionSet set;
  XrAction pose;
  xr::ActionBindings bindings;
  XrSpace gaze_space = XR_NULL_HANDLE;
  std::vector<XrStructureType> events;
};

inline constexpr XrSpaceLocationFlags kValidBits =
    XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
inline constexpr XrSpaceLocationFlags kTrackedBits =
    XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;

}  // namespace support
