// Vulkan as the runtime wants it (XR_KHR_vulkan_enable2): it adds to the creation of instance and device what its
// compositor needs, and says which GPU the headset hangs on. Vulkan's handles stay the caller's to destroy, after the
// session and before the xr::Instance.
#pragma once

#include "xr/instance.hpp"

namespace xr {

class VulkanBinding {
 public:
  // Refers to the instance. Throws Error where the runtime wants a newer Vulkan than api_version.
  VulkanBinding(const Instance& instance, std::uint32_t api_version);

  // As vkCreateInstance, vkEnumeratePhysicalDevices and vkCreateDevice. A failure of Vulkan's own throws Error too.
  [[nodiscard]] VkInstance make_instance(const VkInstanceCreateInfo& info, PFN_vkGetInstanceProcAddr loader) const;
  [[nodiscard]] VkPhysicalDevice pick_device(VkInstance vulkan) const;
  [[nodiscard]] VkDevice make_device(VkPhysicalDevice physical, const VkDeviceCreateInfo& info,
                                     PFN_vkGetInstanceProcAddr loader) const;

 private:
  const Instance& instance_;
};

}  // namespace xr
