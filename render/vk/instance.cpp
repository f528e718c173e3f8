#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <iterator>

#include "render/vk/external.hpp"
#include "render/vk/handles.hpp"

namespace render::vk {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) noexcept {
  try {
    static_cast<MessageLog*>(log)->add(data->pMessage != nullptr ? data->pMessage : "");
  } catch (...) {  // out of memory: the message is lost, the program goes on
  }
  return VK_FALSE;
}

::vk::DebugUtilsMessengerCreateInfoEXT messenger_info(MessageLog& log) {
  using Severity = ::vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = ::vk::DebugUtilsMessageTypeFlagBitsEXT;
  return {{},
          Severity::eWarning | Severity::eError,
          Type::eValidation | Type::ePerformance,  // not the loader's talk about drivers it passed over
          collect_message,
          &log};
}

void require_validation_layer(const raii::Context& context) {
  for (const auto& layer : context.enumerateInstanceLayerProperties()) {
    if (std::string_view(layer.layerName) == kValidationLayer) return;
  }
  throw DeviceError("validation was asked for but the layer " + std::string(kValidationLayer) +
                    " is missing: install the package vulkan-validationlayers");
}

raii::Context load_vulkan() {
  try {
    return raii::Context();
  } catch (const std::runtime_error& error) {
    throw DeviceError(std::string("no Vulkan loader (libvulkan.so.1): ") + error.what());
  }
}

raii::Instance make_instance(const raii::Context& context, const ::vk::InstanceCreateInfo& info,
                             const DeviceMaker* maker) {
  if (maker == nullptr) return {context, info};
  const VkInstanceCreateInfo& plain = info;
  return {context, maker->make_instance(plain, context.getDispatcher()->vkGetInstanceProcAddr)};
}

raii::Instance create_instance(const raii::Context& context, MessageLog& log, bool validation, const DeviceMaker* maker,
                               const std::vector<std::string>& more_extensions) {
  const ::vk::ApplicationInfo application("vergence", 1, nullptr, 0, VK_API_VERSION_1_2);
  ::vk::InstanceCreateInfo info({}, &application);
  std::vector<const char*> extensions;
  for (const std::string& extension : more_extensions) extensions.push_back(extension.c_str());
  info.setPEnabledExtensionNames(extensions);
  if (!validation) return make_instance(context, info, maker);

  require_validation_layer(context);
  extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  const std::array features{::vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
  auto messenger = messenger_info(log);
  const ::vk::ValidationFeaturesEXT checks(features, {}, &messenger);
  const std::array layers{kValidationLayer};
  info.setPEnabledLayerNames(layers).setPEnabledExtensionNames(extensions).setPNext(&checks);
  return make_instance(context, info, maker);
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string name_of(const raii::PhysicalDevice& device) {
  return device.getProperties().deviceName;
}

[[noreturn]] void throw_not_found(const std::vector<raii::PhysicalDevice>& devices, const std::string& wanted) {
  std::string message = "no device '" + wanted + "'; present are";
  for (std::size_t i = 0; i < devices.size(); ++i) {
    message += (i == 0 ? " " : ", ") + std::to_string(i) + " = " + name_of(devices[i]);
  }
  throw DeviceError(message);
}

const raii::PhysicalDevice& best_of(const std::vector<raii::PhysicalDevice>& devices) {
  for (const auto type : {::vk::PhysicalDeviceType::eDiscreteGpu, ::vk::PhysicalDeviceType::eIntegratedGpu}) {
    for (const auto& device : devices) {
      if (device.getProperties().deviceType == type) return device;
    }
  }
  return devices.front();
}

}  // namespace

Instance::Instance(bool validation, const DeviceMaker* maker, const std::vector<std::string>& extensions)
    : context(load_vulkan()) {
  guarded("opening Vulkan", [&] {
    instance = create_instance(context, log, validation, maker, extensions);
    if (validation) messenger = {instance, messenger_info(log)};
  });
}

std::uint32_t compute_queue_family(const raii::PhysicalDevice& device) {
  return queue_family_with(device, ::vk::QueueFlagBits::eCompute);
}

std::uint32_t queue_family_with(const raii::PhysicalDevice& device, ::vk::QueueFlags flags) {
  const auto families = device.getQueueFamilyProperties();
  const auto found =
      std::ranges::find_if(families, [&](const auto& family) { return (family.queueFlags & flags) == flags; });
  return found == families.end() ? VK_QUEUE_FAMILY_IGNORED : static_cast<std::uint32_t>(found - families.begin());
}

std::vector<raii::PhysicalDevice> usable_devices(const Instance& instance) {
  return guarded("looking for Vulkan devices", [&] {
    std::vector<raii::PhysicalDevice> usable;
    for (auto& device : instance.instance.enumeratePhysicalDevices()) {
      if (device.getProperties().apiVersion >= VK_API_VERSION_1_2 &&
          compute_queue_family(device) != VK_QUEUE_FAMILY_IGNORED) {
        usable.push_back(std::move(device));
      }
    }
    return usable;
  });
}

raii::PhysicalDevice pick_device(const std::vector<raii::PhysicalDevice>& devices, const std::string& wanted) {
  if (devices.empty()) throw DeviceError("no Vulkan device: a driver with Vulkan 1.2 and a compute queue is needed");
  if (wanted.empty()) return best_of(devices);

  std::size_t index = 0;
  const char* const end = wanted.data() + wanted.size();
  if (std::ranges::all_of(wanted, [](unsigned char c) { return std::isdigit(c) != 0; })) {
    const auto parsed = std::from_chars(wanted.data(), end, index);
    if (parsed.ec == std::errc() && index < devices.size()) return devices[index];
    throw_not_found(devices, wanted);
  }
  for (const auto& device : devices) {
    if (lower_case(name_of(device)).find(lower_case(wanted)) != std::string::npos) return device;
  }
  throw_not_found(devices, wanted);
}

std::uint32_t showing_queue_family(const raii::PhysicalDevice& device, const raii::SurfaceKHR& surface) {
  const auto extensions = device.enumerateDeviceExtensionProperties();
  if (std::ranges::none_of(extensions, [](const auto& e) {
        return std::string_view(e.extensionName) == VK_KHR_SWAPCHAIN_EXTENSION_NAME;
      })) {
    return VK_QUEUE_FAMILY_IGNORED;
  }
  constexpr auto kNeeded = ::vk::QueueFlagBits::eCompute | ::vk::QueueFlagBits::eGraphics;
  const auto families = device.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if ((families[i].queueFlags & kNeeded) == kNeeded && device.getSurfaceSupportKHR(i, *surface) != VK_FALSE) return i;
  }
  return VK_QUEUE_FAMILY_IGNORED;
}

raii::PhysicalDevice pick_showing_device(const std::vector<raii::PhysicalDevice>& devices, const std::string& wanted,
                                         const raii::SurfaceKHR& surface) {
  const auto shows = [&](const raii::PhysicalDevice& device) {
    return showing_queue_family(device, surface) != VK_QUEUE_FAMILY_IGNORED;
  };
  if (!wanted.empty()) {
    raii::PhysicalDevice device = pick_device(devices, wanted);
    if (!shows(device)) throw DeviceError(name_of(device) + " cannot show pictures in a window of this display");
    return device;
  }
  std::vector<raii::PhysicalDevice> showing;
  std::ranges::copy_if(devices, std::back_inserter(showing), shows);
  if (showing.empty()) throw DeviceError("no Vulkan device shows pictures in a window of this display");
  return pick_device(showing, {});
}

raii::PhysicalDevice given_device(const Instance& instance, const DeviceMaker& maker, const std::string& wanted) {
  raii::PhysicalDevice device(instance.instance, maker.pick_device(*instance.instance));
  const std::string name = name_of(device);
  if (device.getProperties().apiVersion < VK_API_VERSION_1_2 ||
      compute_queue_family(device) == VK_QUEUE_FAMILY_IGNORED) {
    throw DeviceError("the headset hangs on " + name + ", which lacks Vulkan 1.2 or a compute queue");
  }
  if (!wanted.empty() && *pick_device(usable_devices(instance), wanted) != *device) {
    throw DeviceError("'" + wanted + "' is not the device that the headset hangs on, " + name +
                      "; leave the option out");
  }
  return device;
}

}  // namespace render::vk
