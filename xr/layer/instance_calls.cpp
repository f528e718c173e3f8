#include <algorithm>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "tracking/input_error.hpp"
#include "xr/layer/entry_points.hpp"
#include "xr/layer/gaze_settings.hpp"
#include "xr/layer/gaze_state.hpp"
#include "xr/layer/handles.hpp"
#include "xr/layer/structure_chain.hpp"

namespace xr::layer {
namespace {

const XrApiLayerNextInfo& our_link(const XrInstanceCreateInfo* info, const XrApiLayerCreateInfo* layer_info) {
  const bool understood =
      info && layer_info && layer_info->structType == XR_LOADER_INTERFACE_STRUCT_API_LAYER_CREATE_INFO &&
      layer_info->structVersion == XR_API_LAYER_CREATE_INFO_STRUCT_VERSION &&
      layer_info->structSize == sizeof(XrApiLayerCreateInfo) && layer_info->nextInfo &&
      layer_info->nextInfo->structType == XR_LOADER_INTERFACE_STRUCT_API_LAYER_NEXT_INFO &&
      layer_info->nextInfo->structVersion == XR_API_LAYER_NEXT_INFO_STRUCT_VERSION &&
      layer_info->nextInfo->structSize == sizeof(XrApiLayerNextInfo) &&
      std::strcmp(layer_info->nextInfo->layerName, kLayerName) == 0 && layer_info->nextInfo->nextGetInstanceProcAddr &&
      layer_info->nextInfo->nextCreateApiLayerInstance;
  if (!understood) {
    throw CallFailed{XR_ERROR_INITIALIZATION_FAILED};
  }
  return *layer_info->nextInfo;
}

// The runtime's own list: the end of the chain is asked, because other layers need not answer before there is an
// instance.
std::vector<std::string> runtime_extensions(const XrApiLayerNextInfo& ours) {
  const XrApiLayerNextInfo* last = &ours;
  while (last->next) {
    last = last->next;
  }
  PFN_xrVoidFunction function = nullptr;
  last->nextGetInstanceProcAddr(XR_NULL_HANDLE, "xrEnumerateInstanceExtensionProperties", &function);
  const auto enumerate = reinterpret_cast<PFN_xrEnumerateInstanceExtensionProperties>(function);
  std::uint32_t count = 0;
  if (!enumerate || XR_FAILED(enumerate(nullptr, 0, &count, nullptr))) {
    return {};
  }
  XrExtensionProperties blank{};
  blank.type = XR_TYPE_EXTENSION_PROPERTIES;
  std::vector<XrExtensionProperties> properties(count, blank);
  if (XR_FAILED(enumerate(nullptr, count, &count, properties.data()))) {
    return {};
  }
  std::vector<std::string> names;
  for (const XrExtensionProperties& extension : properties) {
    names.emplace_back(extension.extensionName);
  }
  return names;
}

bool contains(const std::vector<std::string>& names, const char* name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Found both by itself and by name, the layer is in the chain twice, and one instance can only be answered for once.
bool stands_below_too(const XrApiLayerNextInfo& ours) {
  for (const XrApiLayerNextInfo* link = ours.next; link; link = link->next) {
    if (std::strcmp(link->layerName, kLayerName) == 0) {
      return true;
    }
  }
  return false;
}

// What the program asked for, less what the runtime does not know and the layer stands in for.
struct ExtensionPlan {
  ExtensionUse gaze_interaction, eye_tracking;
  std::vector<const char*> below;
};

ExtensionPlan plan_extensions(const XrInstanceCreateInfo& info, const XrApiLayerNextInfo& ours) {
  ExtensionPlan plan;
  std::vector<std::string> asked(info.enabledExtensionNames, info.enabledExtensionNames + info.enabledExtensionCount);
  plan.gaze_interaction.program = contains(asked, XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME);
  plan.eye_tracking.program = contains(asked, XR_FB_EYE_TRACKING_SOCIAL_EXTENSION_NAME);
  if (!plan.gaze_interaction.program && !plan.eye_tracking.program) {
    plan.below.assign(info.enabledExtensionNames, info.enabledExtensionNames + info.enabledExtensionCount);
    return plan;
  }
  const auto known = runtime_extensions(ours);
  plan.gaze_interaction.runtime = contains(known, XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME);
  plan.eye_tracking.runtime = contains(known, XR_FB_EYE_TRACKING_SOCIAL_EXTENSION_NAME);
  for (std::uint32_t i = 0; i < info.enabledExtensionCount; ++i) {
    const char* name = info.enabledExtensionNames[i];
    const bool ours_alone =
        (std::strcmp(name, XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME) == 0 && !plan.gaze_interaction.runtime) ||
        (std::strcmp(name, XR_FB_EYE_TRACKING_SOCIAL_EXTENSION_NAME) == 0 && !plan.eye_tracking.runtime);
    if (!ours_alone) {
      plan.below.push_back(name);
    }
  }
  // What came over a socket is stamped with the system's clock, which only the runtime can turn into its own.
  if (contains(known, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME) &&
      !contains(asked, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME)) {
    plan.below.push_back(XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME);
  }
  return plan;
}

XrPath path_of(const Instance& instance, const char* text) {
  XrPath path = XR_NULL_PATH;
  check(instance.next.xrStringToPath(instance.handle, text, &path));
  return path;
}

// The runtime's time at a moment of CLOCK_MONOTONIC (s), where it can tell.
std::function<std::optional<XrTime>(double)> clock_of(const Instance& instance) {
  return [handle = instance.handle,
          convert = instance.next.xrConvertTimespecTimeToTimeKHR](double seconds) -> std::optional<XrTime> {
    const auto whole = static_cast<std::time_t>(seconds);
    const std::timespec moment{whole, static_cast<long>((seconds - static_cast<double>(whole)) * 1e9)};
    XrTime time = 0;
    if (!convert || XR_FAILED(convert(handle, &moment, &time))) {
      return std::nullopt;
    }
    return time;
  };
}

void prepare_gaze(Instance& instance) {
  instance.paths = {.profile = path_of(instance, "/interaction_profiles/ext/eye_gaze_interaction"),
                    .eyes = path_of(instance, "/user/eyes_ext"),
                    .input = path_of(instance, "/user/eyes_ext/input/gaze_ext"),
                    .pose = path_of(instance, "/user/eyes_ext/input/gaze_ext/pose")};
  try {
    const GazeSettings settings = settings_from_environment();
    instance.force = settings.force;
    instance.source = open_source(settings, clock_of(instance));
  } catch (const tracking::InputError& error) {
    // The program is not to fail for it: it finds an eye tracker that sees nothing.
    report_problem(error.what());
    instance.source = std::make_shared<NoGaze>();
  }
}

std::shared_ptr<Instance> make_instance(XrInstance handle, const XrApiLayerNextInfo& ours, const ExtensionPlan& plan) {
  auto instance = std::make_shared<Instance>();
  instance->handle = handle;
  instance->next = load_next_functions(handle, ours.nextGetInstanceProcAddr);
  instance->gaze_interaction = plan.gaze_interaction;
  instance->eye_tracking = plan.eye_tracking;
  if (!instance->idle()) {
    prepare_gaze(*instance);
  }
  return instance;
}

}  // namespace

XRAPI_ATTR XrResult XRAPI_CALL create_instance(const XrInstanceCreateInfo* info, const XrApiLayerCreateInfo* layer_info,
                                               XrInstance* out) noexcept {
  return guarded([&] {
    const XrApiLayerNextInfo& ours = our_link(info, layer_info);
    XrApiLayerCreateInfo below_layer = *layer_info;
    below_layer.nextInfo = ours.next;
    if (stands_below_too(ours)) {
      return ours.nextCreateApiLayerInstance(info, &below_layer, out);
    }
    const ExtensionPlan plan = plan_extensions(*info, ours);
    XrInstanceCreateInfo below = *info;
    below.enabledExtensionCount = static_cast<std::uint32_t>(plan.below.size());
    below.enabledExtensionNames = plan.below.data();
    const XrResult result = check(ours.nextCreateApiLayerInstance(&below, &below_layer, out));
    try {
      handles().instances.add(*out, make_instance(*out, ours, plan));
    } catch (...) {
      const NextFunctions next = load_next_functions(*out, ours.nextGetInstanceProcAddr);
      next.xrDestroyInstance(*out);
      throw;
    }
    return result;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL destroy_instance(XrInstance handle) noexcept {
  return guarded([&] {
    const auto instance = handles().instances.get(handle);
    handles().forget_instance(*instance);
    instance->source.reset();
    return instance->next.xrDestroyInstance(handle);
  });
}

XRAPI_ATTR XrResult XRAPI_CALL get_system_properties(XrInstance handle, XrSystemId system,
                                                     XrSystemProperties* properties) noexcept {
  return guarded([&] {
    const auto instance = handles().instances.get(handle);
    XrResult result;
    {
      const auto unknown = [&](const ExtensionUse& use, XrStructureType type) {
        return use.program && !use.runtime ? type : XR_TYPE_UNKNOWN;
      };
      const HiddenStructures hidden(
          properties, {unknown(instance->gaze_interaction, XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT),
                       unknown(instance->eye_tracking, XR_TYPE_SYSTEM_EYE_TRACKING_PROPERTIES_FB)});
      result = check(instance->next.xrGetSystemProperties(handle, system, properties));
    }
    const GazeSupport runtime = runtime_support(*instance, system);
    if (auto* gaze = find_structure<XrSystemEyeGazeInteractionPropertiesEXT>(
            properties->next, XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT);
        gaze && instance->gaze_interaction.program) {
      gaze->supportsEyeGazeInteraction = runtime.gaze_interaction || instance->source;
    }
    if (auto* eyes = find_structure<XrSystemEyeTrackingPropertiesFB>(properties->next,
                                                                     XR_TYPE_SYSTEM_EYE_TRACKING_PROPERTIES_FB);
        eyes && instance->eye_tracking.program) {
      eyes->supportsEyeTracking = runtime.eye_tracking || instance->source;
    }
    return result;
  });
}

XRAPI_ATTR XrResult XRAPI_CALL poll_event(XrInstance handle, XrEventDataBuffer* event) noexcept {
  return guarded([&] {
    const auto instance = handles().instances.get(handle);
    const XrResult result = check(instance->next.xrPollEvent(handle, event));
    if (result == XR_SUCCESS && event->type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
      const auto& change = *reinterpret_cast<const XrEventDataSessionStateChanged*>(event);
      if (const auto session = handles().sessions.find(change.session)) {
        const std::lock_guard lock(session->mutex);
        session->state = change.state;
      }
    }
    return result == XR_EVENT_UNAVAILABLE ? take_profile_event(*instance, *event) : result;
  });
}

}  // namespace xr::layer
