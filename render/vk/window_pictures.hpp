// Pictures in a window: surface, swapchain, and a copy of what was drawn, scaled to what the window has room for.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "render/vk/external.hpp"

namespace render::vk {

class WindowPictures {
 public:
  // Refers to the device, which was opened with a window. Throws DeviceError where the window takes no bytes of sRGB.
  explicit WindowPictures(const Device& device);
  ~WindowPictures();  // waits
  WindowPictures(const WindowPictures&) = delete;
  WindowPictures& operator=(const WindowPictures&) = delete;

  // Shows a picture of width x height pixels, put together from blocks of display-encoded sRGB, red first, as large as
  // it fits in the middle of a window of `window` pixels. The window's bytes are the picture's. False where it was not
  // shown: the window has no pixels, or all its images are still in use.
  //
  // The host does not wait for the window's display but on a driver that has no other way of presenting (FIFO alone);
  // the device's queue may, until an image is free. Hence a headset's frames must not go through this queue.
  bool show(std::span<const PixelBlock> blocks, int width, int height, const std::array<int, 2>& window);

  // Until the blocks shown last have been read and may be written again.
  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace render::vk
