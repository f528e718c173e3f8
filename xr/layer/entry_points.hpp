// The calls that the layer answers or watches, by the part of the API they belong to. All are C entry points: they
// throw nothing and may come from any thread.
#pragma once

#include "xr/layer/loader_interface.hpp"
#include "xr/openxr_compat.hpp"

namespace xr::layer {

inline constexpr const char* kLayerName = "XR_APILAYER_VERGENCE_gaze";

// instance_calls.cpp
XRAPI_ATTR XrResult XRAPI_CALL create_instance(const XrInstanceCreateInfo* info, const XrApiLayerCreateInfo* layer_info,
                                               XrInstance* instance) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL destroy_instance(XrInstance instance) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL get_system_properties(XrInstance instance, XrSystemId system,
                                                     XrSystemProperties* properties) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL poll_event(XrInstance instance, XrEventDataBuffer* event) noexcept;

// session_calls.cpp
XRAPI_ATTR XrResult XRAPI_CALL create_session(XrInstance instance, const XrSessionCreateInfo* info,
                                              XrSession* session) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL destroy_session(XrSession session) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL attach_session_action_sets(XrSession session,
                                                          const XrSessionActionSetsAttachInfo* info) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL sync_actions(XrSession session, const XrActionsSyncInfo* info) noexcept;

// action_calls.cpp
XRAPI_ATTR XrResult XRAPI_CALL create_action_set(XrInstance instance, const XrActionSetCreateInfo* info,
                                                 XrActionSet* set) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL destroy_action_set(XrActionSet set) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL create_action(XrActionSet set, const XrActionCreateInfo* info,
                                             XrAction* action) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL destroy_action(XrAction action) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL suggest_interaction_profile_bindings(
    XrInstance instance, const XrInteractionProfileSuggestedBinding* suggested) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL get_action_state_pose(XrSession session, const XrActionStateGetInfo* info,
                                                     XrActionStatePose* state) noexcept;

// source_calls.cpp
XRAPI_ATTR XrResult XRAPI_CALL get_current_interaction_profile(XrSession session, XrPath top_level,
                                                               XrInteractionProfileState* state) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL enumerate_bound_sources(XrSession session,
                                                       const XrBoundSourcesForActionEnumerateInfo* info,
                                                       uint32_t capacity, uint32_t* count, XrPath* sources) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL get_input_source_localized_name(XrSession session,
                                                               const XrInputSourceLocalizedNameGetInfo* info,
                                                               uint32_t capacity, uint32_t* count,
                                                               char* buffer) noexcept;

// space_calls.cpp
XRAPI_ATTR XrResult XRAPI_CALL create_action_space(XrSession session, const XrActionSpaceCreateInfo* info,
                                                   XrSpace* space) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL destroy_space(XrSpace space) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL locate_space(XrSpace space, XrSpace base, XrTime time,
                                            XrSpaceLocation* location) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL locate_spaces(XrSession session, const XrSpacesLocateInfoKHR* info,
                                             XrSpaceLocationsKHR* locations) noexcept;

// eye_tracker_calls.cpp
XRAPI_ATTR XrResult XRAPI_CALL create_eye_tracker(XrSession session, const XrEyeTrackerCreateInfoFB* info,
                                                  XrEyeTrackerFB* tracker) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL destroy_eye_tracker(XrEyeTrackerFB tracker) noexcept;
XRAPI_ATTR XrResult XRAPI_CALL get_eye_gazes(XrEyeTrackerFB tracker, const XrEyeGazesInfoFB* info,
                                             XrEyeGazesFB* gazes) noexcept;

// negotiation.cpp
XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance instance, const char* name,
                                                      PFN_xrVoidFunction* function) noexcept;

}  // namespace xr::layer

// Not noexcept only because newer headers declare it so; it calls nothing that throws.
extern "C" __attribute__((visibility("default"))) XRAPI_ATTR XrResult XRAPI_CALL xrNegotiateLoaderApiLayerInterface(
    const XrNegotiateLoaderInfo* loader_info, const char* layer_name, XrNegotiateApiLayerRequest* request);
