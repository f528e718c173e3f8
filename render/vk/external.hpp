// Where this layer meets others that use Vulkan too, an OpenXR runtime or a window: handles of Vulkan's C interface go
// in and out here, and nowhere else.
#pragma once

#include <vulkan/vulkan_core.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/vk/buffer.hpp"
#include "render/vk/commands.hpp"
#include "render/vk/device.hpp"

namespace render::vk {

// Someone who has a say in how instance and device are made (XR_KHR_vulkan_enable2): each call adds what it needs to
// the information given and returns what it made, which then belongs to the Device. What they throw passes through.
struct DeviceMaker {
  std::function<VkInstance(const VkInstanceCreateInfo&, PFN_vkGetInstanceProcAddr)> make_instance;
  std::function<VkPhysicalDevice(VkInstance)> pick_device;
  std::function<VkDevice(VkPhysicalDevice, const VkDeviceCreateInfo&, PFN_vkGetInstanceProcAddr)> make_device;
};

// A window that a device shall show pictures in (window_pictures.hpp). The surface that is made belongs to the Device,
// so the window must outlive that.
struct WindowBinding {
  std::vector<std::string> instance_extensions;
  std::function<VkSurfaceKHR(VkInstance)> make_surface;
};

struct ExternalHandles {
  VkInstance instance;
  VkPhysicalDevice physical;
  VkDevice device;
  std::uint32_t queue_family;
  std::uint32_t queue;  // index in its family
};

[[nodiscard]] ExternalHandles external_handles(const Device& device);

// A colour image of somebody else's: 8 bits a channel, red first or blue first, one level, one layer.
struct ExternalImage {
  VkImage image = VK_NULL_HANDLE;
  int width = 0, height = 0;
};

// A rectangle of pixels of 4 bytes in a buffer that lies row by row, and where it goes in the image.
struct PixelBlock {
  const Buffer* from = nullptr;
  std::size_t offset = 0;  // bytes, of its first pixel
  int row_pixels = 0;      // from one row to the next
  int x = 0, y = 0, width = 0, height = 0;
};

// Copies bytes as they are: an image of an sRGB format takes what is encoded already. The image stands in
// VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL before and after; what it held is lost. A block beyond image or buffer
// throws std::out_of_range.
void copy_to_image(Commands& commands, std::span<const PixelBlock> blocks, const ExternalImage& to);
// The image's pixels, row by row, for an image that allows copies from it.
void copy_from_image(Commands& commands, const ExternalImage& from, Buffer& to);

// Work that is under way while the host goes on: one submission at a time, of several recordings in order.
class Submission {
 public:
  explicit Submission(const Device& device);
  ~Submission();  // waits
  Submission(Submission&&) noexcept;
  Submission& operator=(Submission&&) = delete;

  // Waits for the one before.
  void start(std::span<Commands* const> commands);
  [[nodiscard]] bool is_done() const;
  // The times of all recordings, in order; none where nothing was started.
  std::vector<StageTime> wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace render::vk
