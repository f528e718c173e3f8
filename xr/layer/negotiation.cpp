// The layer's door: what it tells the loader, and which of its functions stand in the chain.
#include <array>
#include <cstring>

#include "xr/layer/entry_points.hpp"
#include "xr/layer/handles.hpp"

namespace xr::layer {
namespace {

enum class Needs { nothing, eye_tracking, locate_spaces };

struct Entry {
  const char* name;
  PFN_xrVoidFunction function;
  Needs needs = Needs::nothing;
};

template <class Function>
PFN_xrVoidFunction plain(Function function) {
  return reinterpret_cast<PFN_xrVoidFunction>(function);
}

// In the chain of every instance.
const std::array kAlways{
    Entry{"xrGetInstanceProcAddr", plain(get_instance_proc_addr)},
    Entry{"xrDestroyInstance", plain(destroy_instance)},
};

// In the chain of an instance whose program asked for gaze.
const std::array kGaze{
    Entry{"xrGetSystemProperties", plain(get_system_properties)},
    Entry{"xrPollEvent", plain(poll_event)},
    Entry{"xrCreateSession", plain(create_session)},
    Entry{"xrDestroySession", plain(destroy_session)},
    Entry{"xrAttachSessionActionSets", plain(attach_session_action_sets)},
    Entry{"xrSyncActions", plain(sync_actions)},
    Entry{"xrCreateActionSet", plain(create_action_set)},
    Entry{"xrDestroyActionSet", plain(destroy_action_set)},
    Entry{"xrCreateAction", plain(create_action)},
    Entry{"xrDestroyAction", plain(destroy_action)},
    Entry{"xrSuggestInteractionProfileBindings", plain(suggest_interaction_profile_bindings)},
    Entry{"xrGetActionStatePose", plain(get_action_state_pose)},
    Entry{"xrGetCurrentInteractionProfile", plain(get_current_interaction_profile)},
    Entry{"xrEnumerateBoundSourcesForAction", plain(enumerate_bound_sources)},
    Entry{"xrGetInputSourceLocalizedName", plain(get_input_source_localized_name)},
    Entry{"xrCreateActionSpace", plain(create_action_space)},
    Entry{"xrDestroySpace", plain(destroy_space)},
    Entry{"xrLocateSpace", plain(locate_space)},
    Entry{"xrLocateSpaces", plain(locate_spaces), Needs::locate_spaces},
    Entry{"xrLocateSpacesKHR", plain(locate_spaces), Needs::locate_spaces},
    Entry{"xrCreateEyeTrackerFB", plain(create_eye_tracker), Needs::eye_tracking},
    Entry{"xrDestroyEyeTrackerFB", plain(destroy_eye_tracker), Needs::eye_tracking},
    Entry{"xrGetEyeGazesFB", plain(get_eye_gazes), Needs::eye_tracking},
};

bool offered(const Entry& entry, const Instance& instance, XrResult below) {
  switch (entry.needs) {
    case Needs::eye_tracking:
      return instance.eye_tracking.program;
    case Needs::locate_spaces:
      return XR_SUCCEEDED(below);
    case Needs::nothing:
      break;
  }
  return true;
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance handle, const char* name,
                                                      PFN_xrVoidFunction* function) noexcept {
  return guarded([&] {
    if (!name || !function) {
      return XR_ERROR_VALIDATION_FAILURE;
    }
    *function = nullptr;
    const auto instance = handles().instances.get(handle);
    for (const Entry& entry : kAlways) {
      if (std::strcmp(name, entry.name) == 0) {
        *function = entry.function;
        return XR_SUCCESS;
      }
    }
    const XrResult below = instance->next.xrGetInstanceProcAddr(handle, name, function);
    if (instance->idle()) {
      return below;
    }
    for (const Entry& entry : kGaze) {
      if (std::strcmp(name, entry.name) == 0 && offered(entry, *instance, below)) {
        *function = entry.function;
        return XR_SUCCESS;
      }
    }
    return below;
  });
}

}  // namespace xr::layer

extern "C" XRAPI_ATTR XrResult XRAPI_CALL xrNegotiateLoaderApiLayerInterface(const XrNegotiateLoaderInfo* loader_info,
                                                                             const char* layer_name,
                                                                             XrNegotiateApiLayerRequest* request) {
  constexpr std::uint32_t kInterface = XR_CURRENT_LOADER_API_LAYER_VERSION;
  const bool understood =
      loader_info && request && loader_info->structType == XR_LOADER_INTERFACE_STRUCT_LOADER_INFO &&
      loader_info->structVersion == XR_LOADER_INFO_STRUCT_VERSION &&
      loader_info->structSize == sizeof(XrNegotiateLoaderInfo) &&
      request->structType == XR_LOADER_INTERFACE_STRUCT_API_LAYER_REQUEST &&
      request->structVersion == XR_API_LAYER_INFO_STRUCT_VERSION &&
      request->structSize == sizeof(XrNegotiateApiLayerRequest) && loader_info->minInterfaceVersion <= kInterface &&
      loader_info->maxInterfaceVersion >= kInterface && loader_info->minApiVersion < XR_MAKE_VERSION(2, 0, 0) &&
      loader_info->maxApiVersion >= XR_MAKE_VERSION(1, 0, 0) &&
      (!layer_name || std::strcmp(layer_name, xr::layer::kLayerName) == 0);
  if (!understood) {
    return XR_ERROR_INITIALIZATION_FAILED;
  }
  request->layerInterfaceVersion = kInterface;
  request->layerApiVersion = XR_MAKE_VERSION(1, 0, 0);
  request->getInstanceProcAddr = xr::layer::get_instance_proc_addr;
  request->createApiLayerInstance = xr::layer::create_instance;
  return XR_SUCCESS;
}
