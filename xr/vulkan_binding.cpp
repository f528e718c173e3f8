#include "xr/vulkan_binding.hpp"

namespace xr {
namespace {

std::string version_text(XrVersion version) {
  return std::to_string(XR_VERSION_MAJOR(version)) + "." + std::to_string(XR_VERSION_MINOR(version));
}

void check_vulkan(VkResult result, const char* call) {
  if (result != VK_SUCCESS) {
    throw Error(std::string("openxr: ") + call + ": VkResult " + std::to_string(static_cast<int>(result)));
  }
}

}  // namespace

VulkanBinding::VulkanBinding(const Instance& instance, std::uint32_t api_version) : instance_(instance) {
  XrGraphicsRequirementsVulkan2KHR required{};
  required.type = XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR;
  check(instance.function<PFN_xrGetVulkanGraphicsRequirements2KHR>("xrGetVulkanGraphicsRequirements2KHR")(
            instance.handle(), instance.system(), &required),
        "xrGetVulkanGraphicsRequirements2KHR");
  const XrVersion ours = XR_MAKE_VERSION(VK_API_VERSION_MAJOR(api_version), VK_API_VERSION_MINOR(api_version), 0);
  // A runtime's upper bound is what it was tested with, not what it refuses.
  if (ours < required.minApiVersionSupported) {
    throw Error("openxr: " + instance.runtime_name() + " wants Vulkan " +
                version_text(required.minApiVersionSupported) + " or newer; this program is written for " +
                version_text(ours));
  }
}

VkInstance VulkanBinding::make_instance(const VkInstanceCreateInfo& info, PFN_vkGetInstanceProcAddr loader) const {
  XrVulkanInstanceCreateInfoKHR wanted{};
  wanted.type = XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR;
  wanted.systemId = instance_.system();
  wanted.pfnGetInstanceProcAddr = loader;
  wanted.vulkanCreateInfo = &info;
  VkInstance vulkan = VK_NULL_HANDLE;
  VkResult result = VK_SUCCESS;
  check(instance_.function<PFN_xrCreateVulkanInstanceKHR>("xrCreateVulkanInstanceKHR")(instance_.handle(), &wanted,
                                                                                       &vulkan, &result),
        "xrCreateVulkanInstanceKHR");
  check_vulkan(result, "xrCreateVulkanInstanceKHR");
  return vulkan;
}

VkPhysicalDevice VulkanBinding::pick_device(VkInstance vulkan) const {
  XrVulkanGraphicsDeviceGetInfoKHR wanted{};
  wanted.type = XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR;
  wanted.systemId = instance_.system();
  wanted.vulkanInstance = vulkan;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  check(instance_.function<PFN_xrGetVulkanGraphicsDevice2KHR>("xrGetVulkanGraphicsDevice2KHR")(instance_.handle(),
                                                                                               &wanted, &physical),
        "xrGetVulkanGraphicsDevice2KHR");
  return physical;
}

VkDevice VulkanBinding::make_device(VkPhysicalDevice physical, const VkDeviceCreateInfo& info,
                                    PFN_vkGetInstanceProcAddr loader) const {
  XrVulkanDeviceCreateInfoKHR wanted{};
  wanted.type = XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR;
  wanted.systemId = instance_.system();
  wanted.pfnGetInstanceProcAddr = loader;
  wanted.vulkanPhysicalDevice = physical;
  wanted.vulkanCreateInfo = &info;
  VkDevice device = VK_NULL_HANDLE;
  VkResult result = VK_SUCCESS;
  check(instance_.function<PFN_xrCreateVulkanDeviceKHR>("xrCreateVulkanDeviceKHR")(instance_.handle(), &wanted, &device,
                                                                                   &result),
        "xrCreateVulkanDeviceKHR");
  check_vulkan(result, "xrCreateVulkanDeviceKHR");
  return device;
}

}  // namespace xr
