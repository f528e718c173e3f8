#include "xr/layer/gaze_state.hpp"

namespace xr::layer {

GazeSupport runtime_support(const Instance& instance, XrSystemId system) {
  XrSystemEyeTrackingPropertiesFB eyes{};
  eyes.type = XR_TYPE_SYSTEM_EYE_TRACKING_PROPERTIES_FB;
  XrSystemEyeGazeInteractionPropertiesEXT gaze{};
  gaze.type = XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT;
  XrSystemProperties properties{};
  properties.type = XR_TYPE_SYSTEM_PROPERTIES;
  if (instance.eye_tracking.program && instance.eye_tracking.runtime) {
    properties.next = &eyes;
  }
  if (instance.gaze_interaction.program && instance.gaze_interaction.runtime) {
    gaze.next = properties.next;
    properties.next = &gaze;
  }
  if (properties.next) {
    check(instance.next.xrGetSystemProperties(instance.handle, system, &properties));
  }
  return {.gaze_interaction = gaze.supportsEyeGazeInteraction != XR_FALSE,
          .eye_tracking = eyes.supportsEyeTracking != XR_FALSE};
}

GazeReading gaze_at(Session& session, XrTime time) {
  XrTime start = 0;
  {
    const std::lock_guard lock(session.mutex);
    if (session.state != XR_SESSION_STATE_FOCUSED || !session.instance->source) {
      return {};
    }
    if (!session.start) {
      session.start = time;
    }
    start = *session.start;
  }
  return session.instance->source->at(time, start);
}

bool tracker_present(Session& session) {
  const std::lock_guard lock(session.mutex);
  return session.state == XR_SESSION_STATE_FOCUSED && session.instance->source && session.instance->source->present();
}

bool gaze_is_active(Session& session, const Action& action) {
  const GazePaths& paths = session.instance->paths;
  const std::lock_guard lock(session.mutex);
  return std::any_of(session.active.begin(), session.active.end(), [&](const ActiveSet& active) {
    return active.set == action.set->handle && (active.subaction == XR_NULL_PATH || active.subaction == paths.eyes);
  });
}

XrSpace view_space(Session& session) {
  const std::lock_guard lock(session.mutex);
  if (session.view == XR_NULL_HANDLE) {
    XrReferenceSpaceCreateInfo info{};
    info.type = XR_TYPE_REFERENCE_SPACE_CREATE_INFO;
    info.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_VIEW;
    info.poseInReferenceSpace.orientation.w = 1.0F;
    check(session.instance->next.xrCreateReferenceSpace(session.handle, &info, &session.view));
  }
  return session.view;
}

XrResult take_profile_event(const Instance& instance, XrEventDataBuffer& event) {
  for (const auto& session : handles().sessions.all()) {
    const std::lock_guard lock(session->mutex);
    if (session->instance.get() == &instance && session->profile_event) {
      session->profile_event = false;
      auto& changed = reinterpret_cast<XrEventDataInteractionProfileChanged&>(event);
      changed = {XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED, nullptr, session->handle};
      return XR_SUCCESS;
    }
  }
  return XR_EVENT_UNAVAILABLE;
}

bool has_gaze_bindings(const Session& session) {
  const auto actions = handles().actions.all();
  return session.gives_gaze && std::any_of(actions.begin(), actions.end(), [&](const auto& action) {
           return action->set->instance == session.instance && action->set->attached && action->gaze;
         });
}

}  // namespace xr::layer
