#include "xr/instance.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "xr/fixed_text.hpp"

namespace xr {
namespace {

constexpr const char* kHowToStart =
    "start one (SteamVR, WiVRn, or Monado's monado-service) and make it the active runtime, or name its manifest in "
    "XR_RUNTIME_JSON";

// The oldest version that has all we use, so that old loaders and old runtimes serve as well as new ones.
constexpr XrVersion kApiVersion = XR_MAKE_VERSION(1, 0, 0);

std::set<std::string, std::less<>> offered_extensions() {
  std::uint32_t count = 0;
  const XrResult result = xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr);
  if (XR_FAILED(result)) {
    throw Error("openxr: no runtime is there (" + result_name(result) + "): " + kHowToStart);
  }
  std::vector<XrExtensionProperties> properties(count, {XR_TYPE_EXTENSION_PROPERTIES, nullptr, {}, 0});
  check(xrEnumerateInstanceExtensionProperties(nullptr, count, &count, properties.data()),
        "xrEnumerateInstanceExtensionProperties");
  std::set<std::string, std::less<>> names;
  for (const XrExtensionProperties& extension : properties) {
    names.emplace(extension.extensionName);
  }
  return names;
}

XrInstance create_instance(const std::string& application, const std::set<std::string, std::less<>>& extensions) {
  std::vector<const char*> names;
  for (const std::string& name : extensions) {
    names.push_back(name.c_str());
  }
  XrInstanceCreateInfo info{};
  info.type = XR_TYPE_INSTANCE_CREATE_INFO;
  copy_text(info.applicationInfo.applicationName, application);
  copy_text(info.applicationInfo.engineName, application);
  info.applicationInfo.apiVersion = kApiVersion;
  info.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
  info.enabledExtensionNames = names.data();
  XrInstance instance = XR_NULL_HANDLE;
  const XrResult result = xrCreateInstance(&info, &instance);
  if (result == XR_ERROR_API_VERSION_UNSUPPORTED) {
    throw Error("openxr: the runtime does not speak OpenXR 1.0; update it");
  }
  if (result == XR_ERROR_API_LAYER_NOT_PRESENT) {
    throw Error(
        "openxr: an API layer named in XR_ENABLE_API_LAYERS is not installed; XR_API_LAYER_PATH says where to look");
  }
  if (XR_FAILED(result)) {
    throw Error("openxr: the runtime does not answer (" + result_name(result) + "): " + kHowToStart);
  }
  return instance;
}

}  // namespace

Instance::Instance(const InstanceConfig& config) {
  // The loader would print what we are about to say.
  ::setenv("XR_LOADER_DEBUG", "none", 0);
  const auto offered = offered_extensions();
  if (!offered.contains(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME)) {
    throw Error("openxr: the runtime does not offer " XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME
                ", which is how it draws with Vulkan; update it, or make another one active");
  }
  extensions_.emplace(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME);
  std::ranges::copy_if(config.wanted_extensions, std::inserter(extensions_, extensions_.end()),
                       [&](const std::string& name) { return offered.contains(name); });
  instance_ = create_instance(config.application, extensions_);
  try {
    XrInstanceProperties runtime{};
    runtime.type = XR_TYPE_INSTANCE_PROPERTIES;
    check(xrGetInstanceProperties(instance_, &runtime), "xrGetInstanceProperties");
    runtime_name_ = runtime.runtimeName;

    XrSystemGetInfo wanted{};
    wanted.type = XR_TYPE_SYSTEM_GET_INFO;
    wanted.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
    const XrResult result = xrGetSystem(instance_, &wanted, &system_);
    if (result == XR_ERROR_FORM_FACTOR_UNAVAILABLE || result == XR_ERROR_FORM_FACTOR_UNSUPPORTED) {
      throw Error("openxr: " + runtime_name_ + " has no headset (" + result_name(result) +
                  "): connect one and switch it on, then start this command again");
    }
    check(result, "xrGetSystem");
    XrSystemProperties properties{};
    get_properties(properties);
    headset_name_ = properties.systemName;

    std::uint32_t count = 0;
    check(xrEnumerateViewConfigurations(instance_, system_, 0, &count, nullptr), "xrEnumerateViewConfigurations");
    std::vector<XrViewConfigurationType> types(count);
    check(xrEnumerateViewConfigurations(instance_, system_, count, &count, types.data()),
          "xrEnumerateViewConfigurations");
    if (std::ranges::find(types, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) == types.end()) {
      throw Error("openxr: " + headset_name_ + " has no stereo view, which two eyes need");
    }
  } catch (...) {
    xrDestroyInstance(instance_);
    throw;
  }
}

Instance::~Instance() {
  xrDestroyInstance(instance_);
}

void Instance::get_properties(XrSystemProperties& properties) const {
  properties.type = XR_TYPE_SYSTEM_PROPERTIES;
  check(xrGetSystemProperties(instance_, system_, &properties), "xrGetSystemProperties");
}

std::optional<XrEventDataBuffer> Instance::poll() const {
  XrEventDataBuffer event{};
  event.type = XR_TYPE_EVENT_DATA_BUFFER;
  if (check(xrPollEvent(instance_, &event), "xrPollEvent") == XR_EVENT_UNAVAILABLE) {
    return std::nullopt;
  }
  return event;
}

XrPath Instance::path(const char* text) const {
  XrPath path = XR_NULL_PATH;
  check(xrStringToPath(instance_, text, &path), "xrStringToPath");
  return path;
}

PFN_xrVoidFunction Instance::function_pointer(const char* name) const {
  PFN_xrVoidFunction function = nullptr;
  check(xrGetInstanceProcAddr(instance_, name, &function), name);
  return function;
}

}  // namespace xr
