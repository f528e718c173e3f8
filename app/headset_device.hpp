// The GPU that a headset hangs on, opened as its runtime wants it.
#pragma once

#include "render/vk/external.hpp"
#include "xr/session.hpp"
#include "xr/vulkan_binding.hpp"

namespace app {

// config.maker is set here.
[[nodiscard]] inline render::vk::Device open_headset_device(const xr::Instance& instance,
                                                            render::vk::DeviceConfig config) {
  const xr::VulkanBinding binding(instance, VK_API_VERSION_1_2);
  const render::vk::DeviceMaker maker{
      .make_instance = [&](const VkInstanceCreateInfo& info,
                           PFN_vkGetInstanceProcAddr loader) { return binding.make_instance(info, loader); },
      .pick_device = [&](VkInstance vulkan) { return binding.pick_device(vulkan); },
      .make_device = [&](VkPhysicalDevice physical, const VkDeviceCreateInfo& info,
                         PFN_vkGetInstanceProcAddr loader) { return binding.make_device(physical, info, loader); }};
  config.maker = &maker;
  return render::vk::Device(config);
}

[[nodiscard]] inline xr::GraphicsBinding graphics_of(const render::vk::Device& device) {
  const render::vk::ExternalHandles handles = render::vk::external_handles(device);
  return {handles.instance, handles.physical, handles.device, handles.queue_family, handles.queue};
}

}  // namespace app
