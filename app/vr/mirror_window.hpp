// --mirror of `vergence vr`: a plain window with what the headset shows, left eye | right eye, and its keys. It has a
// Vulkan device of its own, so that nothing that waits for the desktop's display is on the headset's queue, and the
// main thread, as windows want it; the session has another.
#pragma once

#include <functional>
#include <memory>

#include "app/vr/mirror_link.hpp"
#include "app/window/window.hpp"
#include "render/vk/window_pictures.hpp"

namespace app {

class MirrorWindow {
 public:
  // Hidden until the session has something to show. Throws WindowError without a display, and where no device shows
  // pictures there.
  MirrorWindow();

  // Runs the session on another thread and the window on this one until the session has ended; what it throws comes out
  // here. A closed window, the key Q and a window that fails end it as Ctrl-C does.
  void run_beside(const std::function<void(MirrorLink&)>& session);

 private:
  void turn(MirrorLink& link);
  void heed_keys(MirrorLink& link);
  void redraw(const std::array<int, 2>& size);

  Window window_;
  render::vk::WindowBinding binding_;
  render::vk::Device device_;
  render::vk::WindowPictures pictures_;
  render::MirrorPicture picture_;
  std::unique_ptr<render::vk::Buffer> pixels_;  // of the picture that is drawn
  std::array<int, 2> window_size_{};            // when it was drawn; 0: it must be again
};

}  // namespace app
