#include "xr/layer/entry_points.hpp"
#include "xr/layer/gaze_state.hpp"
#include "xr/layer/handles.hpp"

namespace xr::layer {

XRAPI_ATTR XrResult XRAPI_CALL create_session(XrInstance handle, const XrSessionCreateInfo* info,
                                              XrSession* out) noexcept {
  return guarded([&] {
    const auto instance = handles().instances.get(handle);
    const XrResult result = check(instance->next.xrCreateSession(handle, info, out));
    auto session = std::make_shared<Session>();
    session->instance = instance;
    session->handle = *out;
    if (instance->source) {
      const GazeSupport runtime = instance->force ? GazeSupport{} : runtime_support(*instance, info->systemId);
      session->gives_gaze = instance->gaze_interaction.program && !runtime.gaze_interaction;
      session->gives_eyes = instance->eye_tracking.program && !runtime.eye_tracking;
    }
    handles().sessions.add(*out, session);
    return result;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL destroy_session(XrSession handle) noexcept {
  return guarded([&] {
    const auto session = handles().sessions.get(handle);
    handles().forget_session(*session);
    const NextFunctions& next = session->instance->next;
    if (session->view != XR_NULL_HANDLE) {
      next.xrDestroySpace(session->view);
    }
    return next.xrDestroySession(handle);
  });
}

XRAPI_ATTR XrResult XRAPI_CALL attach_session_action_sets(XrSession handle,
                                                          const XrSessionActionSetsAttachInfo* info) noexcept {
  return guarded([&] {
    const auto session = handles().sessions.get(handle);
    const XrResult result = check(session->instance->next.xrAttachSessionActionSets(handle, info));
    for (std::uint32_t i = 0; i < info->countActionSets; ++i) {
      if (const auto set = handles().action_sets.find(info->actionSets[i])) {
        set->attached = true;
      }
    }
    const std::lock_guard lock(session->mutex);
    session->attached = true;
    return result;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL sync_actions(XrSession handle, const XrActionsSyncInfo* info) noexcept {
  return guarded([&] {
    const auto session = handles().sessions.get(handle);
    const Instance& instance = *session->instance;
    std::vector<ActiveSet> active;
    std::vector<XrActiveActionSet> below;
    for (std::uint32_t i = 0; i < (info ? info->countActiveActionSets : 0); ++i) {
      const XrActiveActionSet& set = info->activeActionSets[i];
      active.push_back({set.actionSet, set.subactionPath});
      // A runtime without the extension knows no action of the eyes.
      if (instance.gaze_interaction.runtime || set.subactionPath != instance.paths.eyes) {
        below.push_back(set);
      }
    }
    XrActionsSyncInfo below_info = info ? *info : XrActionsSyncInfo{};
    below_info.countActiveActionSets = static_cast<std::uint32_t>(below.size());
    below_info.activeActionSets = below.empty() ? nullptr : below.data();
    const XrResult result = check(instance.next.xrSyncActions(handle, info ? &below_info : nullptr));
    const bool gaze = has_gaze_bindings(*session);
    const std::lock_guard lock(session->mutex);
    session->active = result == XR_SUCCESS ? std::move(active) : std::vector<ActiveSet>{};
    if (result == XR_SUCCESS && !session->synchronized) {
      session->synchronized = true;
      session->profile_event = gaze;
    }
    return result;
  });
}

}  // namespace xr::layer
