// What stands below the gaze layer in its unit tests: a runtime of plain functions that writes down what it is told and
// answers as the test has set it. There is one at a time, for C functions have no other place to keep it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "xr/convert.hpp"
#include "xr/layer/entry_points.hpp"

namespace support {

struct FakeRuntime {
  // What it can do.
  std::set<std::string> extensions{XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME, XR_MND_HEADLESS_EXTENSION_NAME};
  bool has_gaze = false, has_eyes = false;
  XrResult create_result = XR_SUCCESS;
  // Where things are in any base space; whatever is no hand is the head.
  XrPosef head = xr::kIdentityPose, hand = xr::kIdentityPose;
  XrSpaceLocationFlags head_flags = 15, hand_flags = 0;
  bool focused = true;  // xrSyncActions succeeds

  // What it was told.
  std::vector<std::string> enabled;
  std::vector<XrPath> subaction_paths, suggested_profiles;
  std::vector<XrStructureType> system_chain;
  XrPath space_subaction = 999, state_subaction = 999;
  std::uint32_t synced_sets = 999;
  int reference_spaces = 0, destroyed_spaces = 0, live_instances = 0;
  std::vector<XrEventDataBuffer> events;

  std::map<std::string, XrPath> paths;
  std::uintptr_t last_handle = 0x1000;

  FakeRuntime() { current() = this; }
  ~FakeRuntime() { current() = nullptr; }
  FakeRuntime(const FakeRuntime&) = delete;
  FakeRuntime& operator=(const FakeRuntime&) = delete;

  static FakeRuntime*& current() {
    static FakeRuntime* runtime = nullptr;
    return runtime;
  }

  XrPath path(const std::string& text) { return paths.emplace(text, paths.size() + 1).first->second; }

  void tell_state(XrSession session, XrSessionState state) {
    XrEventDataBuffer buffer{};
    auto& event = reinterpret_cast<XrEventDataSessionStateChanged&>(buffer);
    event.type = XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED;
    event.session = session;
    event.state = state;
    events.push_back(buffer);
  }
};

namespace fake {

inline FakeRuntime& runtime() {
  return *FakeRuntime::current();
}

template <class Handle>
Handle new_handle() {
  return reinterpret_cast<Handle>(runtime().last_handle += 16);
}

inline XrResult XRAPI_CALL enumerate_extensions(const char*, uint32_t capacity, uint32_t* count,
                                                XrExtensionProperties* out) {
  *count = static_cast<std::uint32_t>(runtime().extensions.size());
  if (capacity > 0) {
    for (const std::string& name : runtime().extensions) {
      std::strncpy((out++)->extensionName, name.c_str(), XR_MAX_EXTENSION_NAME_SIZE - 1);
    }
  }
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL create_instance(const XrInstanceCreateInfo* info, const XrApiLayerCreateInfo*,
                                           XrInstance* out) {
  runtime().enabled.assign(info->enabledExtensionNames, info->enabledExtensionNames + info->enabledExtensionCount);
  if (XR_SUCCEEDED(runtime().create_result)) {
    *out = new_handle<XrInstance>();
    ++runtime().live_instances;
  }
  return runtime().create_result;
}

inline XrResult XRAPI_CALL destroy_instance(XrInstance) {
  --runtime().live_instances;
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL string_to_path(XrInstance, const char* text, XrPath* path) {
  *path = runtime().path(text);
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL get_system_properties(XrInstance, XrSystemId, XrSystemProperties* properties) {
  runtime().system_chain.clear();
  for (auto* at = static_cast<XrBaseOutStructure*>(properties->next); at; at = at->next) {
    runtime().system_chain.push_back(at->type);
    if (at->type == XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT) {
      reinterpret_cast<XrSystemEyeGazeInteractionPropertiesEXT*>(at)->supportsEyeGazeInteraction = runtime().has_gaze;
    } else if (at->type == XR_TYPE_SYSTEM_EYE_TRACKING_PROPERTIES_FB) {
      reinterpret_cast<XrSystemEyeTrackingPropertiesFB*>(at)->supportsEyeTracking = runtime().has_eyes;
    }
  }
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL poll_event(XrInstance, XrEventDataBuffer* event) {
  if (runtime().events.empty()) {
    return XR_EVENT_UNAVAILABLE;
  }
  *event = runtime().events.front();
  runtime().events.erase(runtime().events.begin());
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL create_session(XrInstance, const XrSessionCreateInfo*, XrSession* out) {
  *out = new_handle<XrSession>();
  return XR_SUCCESS;
}

template <class Handle>
XrResult XRAPI_CALL destroy(Handle) {
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL destroy_space(XrSpace) {
  ++runtime().destroyed_spaces;
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL create_reference_space(XrSession, const XrReferenceSpaceCreateInfo*, XrSpace* out) {
  ++runtime().reference_spaces;
  *out = new_handle<XrSpace>();
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL create_action_space(XrSession, const XrActionSpaceCreateInfo* info, XrSpace* out) {
  runtime().space_subaction = info->subactionPath;
  // The low bit marks a hand's space.
  *out = reinterpret_cast<XrSpace>(reinterpret_cast<std::uintptr_t>(new_handle<XrSpace>()) | 1U);
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL locate_space(XrSpace space, XrSpace, XrTime time, XrSpaceLocation* location) {
  if (time <= 0) {
    return XR_ERROR_TIME_INVALID;
  }
  const bool hand = (reinterpret_cast<std::uintptr_t>(space) & 1U) != 0;
  location->pose = hand ? runtime().hand : runtime().head;
  location->locationFlags = hand ? runtime().hand_flags : runtime().head_flags;
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL create_action_set(XrInstance, const XrActionSetCreateInfo*, XrActionSet* out) {
  *out = new_handle<XrActionSet>();
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL create_action(XrActionSet, const XrActionCreateInfo* info, XrAction* out) {
  runtime().subaction_paths.assign(info->subactionPaths, info->subactionPaths + info->countSubactionPaths);
  *out = new_handle<XrAction>();
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL suggest_bindings(XrInstance, const XrInteractionProfileSuggestedBinding* suggested) {
  runtime().suggested_profiles.push_back(suggested->interactionProfile);
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL attach(XrSession, const XrSessionActionSetsAttachInfo*) {
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL sync(XrSession, const XrActionsSyncInfo* info) {
  runtime().synced_sets = info->countActiveActionSets;
  return runtime().focused ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}

inline XrResult XRAPI_CALL state_pose(XrSession, const XrActionStateGetInfo* info, XrActionStatePose* state) {
  runtime().state_subaction = info->subactionPath;
  state->isActive = runtime().hand_flags != 0;
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL current_profile(XrSession, XrPath, XrInteractionProfileState* state) {
  state->interactionProfile = runtime().path("/interaction_profiles/of/the/runtime");
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL bound_sources(XrSession, const XrBoundSourcesForActionEnumerateInfo*, uint32_t,
                                         uint32_t* count, XrPath*) {
  *count = 0;
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL localized_name(XrSession, const XrInputSourceLocalizedNameGetInfo*, uint32_t,
                                          uint32_t* count, char*) {
  *count = 1;
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL create_eye_tracker(XrSession, const XrEyeTrackerCreateInfoFB*, XrEyeTrackerFB* out) {
  *out = new_handle<XrEyeTrackerFB>();
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL get_eye_gazes(XrEyeTrackerFB, const XrEyeGazesInfoFB*, XrEyeGazesFB* gazes) {
  gazes->time = 77;
  return XR_SUCCESS;
}

inline XrResult XRAPI_CALL get_instance_proc_addr(XrInstance, const char* name, PFN_xrVoidFunction* function) {
  const auto plain = [](auto f) { return reinterpret_cast<PFN_xrVoidFunction>(f); };
  static const std::map<std::string, PFN_xrVoidFunction> functions{
      {"xrEnumerateInstanceExtensionProperties", plain(enumerate_extensions)},
      {"xrDestroyInstance", plain(destroy_instance)},
      {"xrStringToPath", plain(string_to_path)},
      {"xrGetSystemProperties", plain(get_system_properties)},
      {"xrPollEvent", plain(poll_event)},
      {"xrCreateSession", plain(create_session)},
      {"xrDestroySession", plain(destroy<XrSession>)},
      {"xrDestroySpace", plain(destroy_space)},
      {"xrCreateReferenceSpace", plain(create_reference_space)},
      {"xrCreateActionSpace", plain(create_action_space)},
      {"xrLocateSpace", plain(locate_space)},
      {"xrCreateActionSet", plain(create_action_set)},
      {"xrDestroyActionSet", plain(destroy<XrActionSet>)},
      {"xrCreateAction", plain(create_action)},
      {"xrDestroyAction", plain(destroy<XrAction>)},
      {"xrSuggestInteractionProfileBindings", plain(suggest_bindings)},
      {"xrAttachSessionActionSets", plain(attach)},
      {"xrSyncActions", plain(sync)},
      {"xrGetActionStatePose", plain(state_pose)},
      {"xrGetCurrentInteractionProfile", plain(current_profile)},
      {"xrEnumerateBoundSourcesForAction", plain(bound_sources)},
      {"xrGetInputSourceLocalizedName", plain(localized_name)},
      {"xrCreateEyeTrackerFB", plain(create_eye_tracker)},
      {"xrDestroyEyeTrackerFB", plain(destroy<XrEyeTrackerFB>)},
      {"xrGetEyeGazesFB", plain(get_eye_gazes)},
  };
  const auto at = functions.find(name);
  const bool of_eyes = std::strstr(name, "FB") != nullptr;
  const bool known = at != functions.end() &&
                     (!of_eyes || std::ranges::find(runtime().enabled, XR_FB_EYE_TRACKING_SOCIAL_EXTENSION_NAME) !=
                                      runtime().enabled.end());
  *function = known ? at->second : nullptr;
  return known ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace fake
}  // namespace support
