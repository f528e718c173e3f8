// The images of one eye that go to the compositor, in turn.
#pragma once

#include <cstdint>
#include <vector>

#include "xr/session.hpp"

namespace xr {

struct SwapchainConfig {
  int width = 0, height = 0;
  bool readable = false;  // also to be copied from, for a screenshot
};

class Swapchain {
 public:
  // Refers to the session. The format is one of 8-bit sRGB (the compositor decodes it), red first where there is a
  // choice; a runtime without one throws Error.
  Swapchain(const Session& session, const SwapchainConfig& config);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  [[nodiscard]] XrSwapchain handle() const { return swapchain_; }
  [[nodiscard]] VkFormat format() const { return format_; }
  [[nodiscard]] int width() const { return config_.width; }
  [[nodiscard]] int height() const { return config_.height; }
  // In VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL between acquire and release, and to be left so.
  [[nodiscard]] const std::vector<VkImage>& images() const { return images_; }

  // The image to be drawn next, once the compositor has done with it.
  [[nodiscard]] std::uint32_t acquire();
  // All work on it has been submitted.
  void release();

 private:
  SwapchainConfig config_;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  XrSwapchain swapchain_ = XR_NULL_HANDLE;
  std::vector<VkImage> images_;
};

}  // namespace xr
