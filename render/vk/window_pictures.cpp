#include "render/vk/window_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "render/vk/handles.hpp"

namespace render::vk {
namespace {

using Access = ::vk::AccessFlagBits;
using Layout = ::vk::ImageLayout;
using Stage = ::vk::PipelineStageFlagBits;

const ::vk::ImageSubresourceRange kWholeImage(::vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
const ::vk::ImageSubresourceLayers kOneLayer(::vk::ImageAspectFlagBits::eColor, 0, 0, 1);
constexpr auto kSurfaceColours = ::vk::ColorSpaceKHR::eSrgbNonlinear;

// Of a window: bytes go in as they are. Where a window has sRGB formats alone, the picture's image has one as well:
// what the blit decodes at one end it encodes at the other.
struct Formats {
  ::vk::Format window, picture;
};

Formats formats_for(const raii::PhysicalDevice& physical, const raii::SurfaceKHR& surface) {
  constexpr std::array kKnown{Formats{::vk::Format::eB8G8R8A8Unorm, ::vk::Format::eR8G8B8A8Unorm},
                              Formats{::vk::Format::eR8G8B8A8Unorm, ::vk::Format::eR8G8B8A8Unorm},
                              Formats{::vk::Format::eB8G8R8A8Srgb, ::vk::Format::eR8G8B8A8Srgb},
                              Formats{::vk::Format::eR8G8B8A8Srgb, ::vk::Format::eR8G8B8A8Srgb}};
  const auto offered = physical.getSurfaceFormatsKHR(*surface);
  for (const Formats& formats : kKnown) {
    if (std::ranges::find(offered, ::vk::SurfaceFormatKHR(formats.window, kSurfaceColours)) != offered.end()) {
      return formats;
    }
  }
  throw DeviceError("the window takes no pictures of 8 bits a channel in sRGB");
}

// Mailbox and immediate presents never wait for the display; FIFO is what every driver has.
::vk::PresentModeKHR present_mode(const raii::PhysicalDevice& physical, const raii::SurfaceKHR& surface) {
  using Mode = ::vk::PresentModeKHR;
  const auto offered = physical.getSurfacePresentModesKHR(*surface);
  for (const Mode mode : {Mode::eMailbox, Mode::eImmediate}) {
    if (std::ranges::find(offered, mode) != offered.end()) return mode;
  }
  return Mode::eFifo;
}

::vk::Extent2D extent_of(const ::vk::SurfaceCapabilitiesKHR& capabilities, const std::array<int, 2>& window) {
  constexpr std::uint32_t kAsItsSwapchain = std::numeric_limits<std::uint32_t>::max();
  if (capabilities.currentExtent.width != kAsItsSwapchain) return capabilities.currentExtent;
  const auto& least = capabilities.minImageExtent;
  const auto& most = capabilities.maxImageExtent;
  return {std::clamp(static_cast<std::uint32_t>(window[0]), least.width, std::max(least.width, most.width)),
          std::clamp(static_cast<std::uint32_t>(window[1]), least.height, std::max(least.height, most.height))};
}

std::uint32_t image_count(const ::vk::SurfaceCapabilitiesKHR& capabilities) {
  const std::uint32_t wanted = std::max(3U, capabilities.minImageCount);  // one shown, one waiting, one to draw into
  return capabilities.maxImageCount == 0 ? wanted : std::min(wanted, capabilities.maxImageCount);
}

::vk::CompositeAlphaFlagBitsKHR alpha_of(const ::vk::SurfaceCapabilitiesKHR& capabilities) {
  using Alpha = ::vk::CompositeAlphaFlagBitsKHR;
  return capabilities.supportedCompositeAlpha & Alpha::eOpaque ? Alpha::eOpaque : Alpha::eInherit;
}

// The corners of a picture, scaled to fit in the middle of an extent.
std::array<::vk::Offset3D, 2> fitted(int width, int height, const ::vk::Extent2D& extent) {
  const double scale = std::min(static_cast<double>(extent.width) / width, static_cast<double>(extent.height) / height);
  const auto along = [&](int pixels, std::uint32_t room) {
    return std::clamp(static_cast<int>(std::lround(scale * pixels)), 1, static_cast<int>(room));
  };
  const int w = along(width, extent.width);
  const int h = along(height, extent.height);
  const int x = (static_cast<int>(extent.width) - w) / 2;
  const int y = (static_cast<int>(extent.height) - h) / 2;
  return {::vk::Offset3D{x, y, 0}, ::vk::Offset3D{x + w, y + h, 1}};
}

void change(const raii::CommandBuffer& commands, ::vk::Image image, Layout from, Layout to, ::vk::AccessFlags before,
            ::vk::AccessFlags after) {
  const ::vk::ImageMemoryBarrier barrier(before, after, from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                                         image, kWholeImage);
  // From the transfer stage, at which the acquired image is waited for, or from earlier copies.
  commands.pipelineBarrier(Stage::eTransfer | Stage::eAllCommands, Stage::eTransfer, {}, {}, {}, barrier);
}

struct Swapchain {
  Swapchain(const DeviceState& device, const ::vk::SurfaceCapabilitiesKHR& capabilities, ::vk::Extent2D size,
            ::vk::Format format, ::vk::PresentModeKHR mode, ::vk::SwapchainKHR before)
      : extent(size),
        handle(device.device, {{},
                               *device.surface,
                               image_count(capabilities),
                               format,
                               kSurfaceColours,
                               size,
                               1,
                               ::vk::ImageUsageFlagBits::eTransferDst,
                               ::vk::SharingMode::eExclusive,
                               {},
                               capabilities.currentTransform,
                               alpha_of(capabilities),
                               mode,
                               VK_TRUE,
                               before}) {
    for (const VkImage image : handle.getImages()) {
      images.emplace_back(image);
      drawn.emplace_back(device.device, ::vk::SemaphoreCreateInfo());
    }
  }

  ::vk::Extent2D extent;
  raii::SwapchainKHR handle;
  std::vector<::vk::Image> images;
  std::vector<raii::Semaphore> drawn;  // of each image, for its present
};

// What is shown, at its own size.
struct Picture {
  Picture(const DeviceState& device, int w, int h, ::vk::Format format) : width(w), height(h) {
    using Usage = ::vk::ImageUsageFlagBits;
    const ::vk::Extent3D extent{static_cast<std::uint32_t>(w), static_cast<std::uint32_t>(h), 1};
    image = {device.device,
             {{},
              ::vk::ImageType::e2D,
              format,
              extent,
              1,
              1,
              ::vk::SampleCountFlagBits::e1,
              ::vk::ImageTiling::eOptimal,
              Usage::eTransferSrc | Usage::eTransferDst | Usage::eColorAttachment}};  // copy_to_image's layout
    const auto needs = image.getMemoryRequirements();
    memory = {device.device, {needs.size, memory_type(device, needs.memoryTypeBits)}};
    image.bindMemory(*memory, 0);
  }

  static std::uint32_t memory_type(const DeviceState& device, std::uint32_t allowed) {
    const auto properties = device.physical.getMemoryProperties();
    std::optional<std::uint32_t> any;
    for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
      if ((allowed & (1U << i)) == 0) continue;
      if (properties.memoryTypes[i].propertyFlags & ::vk::MemoryPropertyFlagBits::eDeviceLocal) return i;
      if (!any) any = i;
    }
    return any.value();  // every image has a type of memory
  }

  int width, height;
  raii::DeviceMemory memory = nullptr;
  raii::Image image = nullptr;
};

}  // namespace

struct WindowPictures::State {
  explicit State(const Device& owner)
      : device_handle(owner),
        device(owner.state()),
        formats(formats_for(device->physical, device->surface)),
        mode(present_mode(device->physical, device->surface)),
        acquired(device->device, ::vk::SemaphoreCreateInfo()),
        done(device->device, ::vk::FenceCreateInfo()) {}

  void wait() {
    if (!under_way) return;
    const auto result = device->device.waitForFences(*done, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
    if (result != ::vk::Result::eSuccess) {
      throw DeviceError("waiting for " + device->name + ": " + ::vk::to_string(result));
    }
    device->device.resetFences(*done);
    under_way.reset();
  }

  // False without pixels to show anything in.
  bool fit_swapchain(const std::array<int, 2>& window) {
    if (window[0] <= 0 || window[1] <= 0) return false;
    const auto capabilities = device->physical.getSurfaceCapabilitiesKHR(*device->surface);
    const ::vk::Extent2D extent = extent_of(capabilities, window);
    if (extent.width == 0 || extent.height == 0) return false;
    if (!swapchain || is_stale || swapchain->extent != extent) {
      device->queue.waitIdle();  // presents of the old images
      auto fresh = std::make_unique<Swapchain>(*device, capabilities, extent, formats.window, mode,
                                               swapchain ? *swapchain->handle : ::vk::SwapchainKHR());
      swapchain = std::move(fresh);
      is_stale = false;
    }
    return true;
  }

  // The image to draw into, if one is free at once.
  std::optional<std::uint32_t> acquire() {
    try {
      const auto [result, index] = swapchain->handle.acquireNextImage(0, *acquired);
      if (result == ::vk::Result::eTimeout || result == ::vk::Result::eNotReady) return std::nullopt;
      is_stale = result == ::vk::Result::eSuboptimalKHR;
      return index;
    } catch (const ::vk::OutOfDateKHRError&) {
      is_stale = true;
      return std::nullopt;
    }
  }

  void record(Commands& commands, std::span<const PixelBlock> blocks, ::vk::Image target) const {
    copy_to_image(commands, blocks, {*picture->image, picture->width, picture->height});
    const raii::CommandBuffer& list = commands.state()->recording();
    change(list, *picture->image, Layout::eColorAttachmentOptimal, Layout::eTransferSrcOptimal, Access::eTransferWrite,
           Access::eTransferRead);
    change(list, target, Layout::eUndefined, Layout::eTransferDstOptimal, {}, Access::eTransferWrite);
    list.clearColorImage(target, Layout::eTransferDstOptimal, ::vk::ClearColorValue(std::array{0.0F, 0.0F, 0.0F, 1.0F}),
                         kWholeImage);
    change(list, target, Layout::eTransferDstOptimal, Layout::eTransferDstOptimal, Access::eTransferWrite,
           Access::eTransferWrite);
    const std::array from{::vk::Offset3D{0, 0, 0}, ::vk::Offset3D{picture->width, picture->height, 1}};
    const ::vk::ImageBlit blit(kOneLayer, from, kOneLayer, fitted(picture->width, picture->height, swapchain->extent));
    list.blitImage(*picture->image, Layout::eTransferSrcOptimal, target, Layout::eTransferDstOptimal, blit,
                   ::vk::Filter::eLinear);
    change(list, target, Layout::eTransferDstOptimal, Layout::ePresentSrcKHR, Access::eTransferWrite, {});
  }

  void submit(Commands& commands, std::uint32_t index) {
    commands.state()->finish();
    const ::vk::PipelineStageFlags stage = Stage::eTransfer;
    const ::vk::SubmitInfo info(*acquired, stage, *commands.state()->commands, *swapchain->drawn[index]);
    device->queue.submit(info, *done);
    under_way = commands.state();
  }

  bool present(std::uint32_t index) {
    try {
      const auto result = device->queue.presentKHR({*swapchain->drawn[index], *swapchain->handle, index});
      is_stale = is_stale || result == ::vk::Result::eSuboptimalKHR;
      return true;
    } catch (const ::vk::OutOfDateKHRError&) {
      is_stale = true;
      return false;
    }
  }

  bool show(std::span<const PixelBlock> blocks, int width, int height, const std::array<int, 2>& window) {
    wait();
    if (!fit_swapchain(window)) return false;
    if (!picture || picture->width != width || picture->height != height) {
      picture.reset();
      picture.emplace(*device, width, height, formats.picture);
    }
    const auto index = acquire();
    if (!index) return false;
    Commands commands(device_handle);
    record(commands, blocks, swapchain->images[*index]);
    submit(commands, *index);
    return present(*index);
  }

  const Device& device_handle;
  std::shared_ptr<DeviceState> device;
  Formats formats;
  ::vk::PresentModeKHR mode;
  std::optional<Picture> picture;
  std::unique_ptr<Swapchain> swapchain;
  bool is_stale = false;  // the window has changed since the swapchain was made
  raii::Semaphore acquired;
  raii::Fence done;
  std::shared_ptr<CommandsState> under_way;
};

WindowPictures::WindowPictures(const Device& device) {
  if (!*device.state()->surface) throw std::invalid_argument("this device was opened without a window");
  state_ = guarded("showing pictures in a window", [&] { return std::make_unique<State>(device); });
}

WindowPictures::~WindowPictures() {
  try {
    state_->wait();
    state_->device->queue.waitIdle();
  } catch (const std::exception&) {  // a lost device has nothing under way
  }
}

bool WindowPictures::show(std::span<const PixelBlock> blocks, int width, int height, const std::array<int, 2>& window) {
  return guarded("showing a picture in a window", [&] { return state_->show(blocks, width, height, window); });
}

void WindowPictures::wait() {
  guarded("showing a picture in a window", [&] { state_->wait(); });
}

}  // namespace render::vk
