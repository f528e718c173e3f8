#include "xr/swapchain.hpp"

#include <algorithm>

namespace xr {
namespace {

VkFormat choose_format(const Session& session) {
  std::uint32_t count = 0;
  check(xrEnumerateSwapchainFormats(session.handle(), 0, &count, nullptr), "xrEnumerateSwapchainFormats");
  std::vector<std::int64_t> offered(count);
  check(xrEnumerateSwapchainFormats(session.handle(), count, &count, offered.data()), "xrEnumerateSwapchainFormats");
  for (const VkFormat format : {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_SRGB}) {
    if (std::ranges::find(offered, static_cast<std::int64_t>(format)) != offered.end()) {
      return format;
    }
  }
  throw Error("openxr: " + session.instance().runtime_name() + " takes no 8-bit sRGB images");
}

std::vector<VkImage> images_of(XrSwapchain swapchain) {
  std::uint32_t count = 0;
  check(xrEnumerateSwapchainImages(swapchain, 0, &count, nullptr), "xrEnumerateSwapchainImages");
  std::vector<XrSwapchainImageVulkan2KHR> images(count, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR, nullptr, VK_NULL_HANDLE});
  check(xrEnumerateSwapchainImages(swapchain, count, &count,
                                   reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
        "xrEnumerateSwapchainImages");
  std::vector<VkImage> handles;
  std::ranges::transform(images, std::back_inserter(handles), &XrSwapchainImageVulkan2KHR::image);
  return handles;
}

}  // namespace

Swapchain::Swapchain(const Session& session, const SwapchainConfig& config)
    : config_(config), format_(choose_format(session)) {
  XrSwapchainCreateInfo info{};
  info.type = XR_TYPE_SWAPCHAIN_CREATE_INFO;
  // Pixels arrive as a copy of bytes that are sRGB already: no view, so no mutable format.
  info.usageFlags =
      XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT;
  if (config.readable) {
    info.usageFlags |= XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT;
  }
  info.format = format_;
  info.sampleCount = 1;
  info.width = static_cast<std::uint32_t>(config.width);
  info.height = static_cast<std::uint32_t>(config.height);
  info.faceCount = info.arraySize = info.mipCount = 1;
  check(xrCreateSwapchain(session.handle(), &info, &swapchain_), "xrCreateSwapchain");
  try {
    images_ = images_of(swapchain_);
  } catch (...) {
    xrDestroySwapchain(swapchain_);
    throw;
  }
}

Swapchain::~Swapchain() {
  xrDestroySwapchain(swapchain_);
}

std::uint32_t Swapchain::acquire() {
  std::uint32_t index = 0;
  check(xrAcquireSwapchainImage(swapchain_, nullptr, &index), "xrAcquireSwapchainImage");
  XrSwapchainImageWaitInfo wait{};
  wait.type = XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO;
  wait.timeout = XR_INFINITE_DURATION;
  check(xrWaitSwapchainImage(swapchain_, &wait), "xrWaitSwapchainImage");
  return index;
}

void Swapchain::release() {
  check(xrReleaseSwapchainImage(swapchain_, nullptr), "xrReleaseSwapchainImage");
}

}  // namespace xr
