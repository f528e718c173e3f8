// Brings what the headset shows to the window that mirrors it. All of it happens on the thread of the session, between
// the handing over of one frame and the waiting for the next, so its use of the session's queue is in turn with the
// runtime's; it never waits, and what is not ready is left for later.
#pragma once

#include <chrono>
#include <memory>

#include "app/vr/mirror_link.hpp"
#include "render/mirror_copy.hpp"

namespace app {

class MirrorFeed {
 public:
  // Refers to both. size: of each eye's picture.
  MirrorFeed(MirrorLink& link, const render::vk::Device& device, const std::array<int, 2>& size)
      : link_(link), copy_(device) {
    link.expect(2 * size[0], size[1]);
  }

  // A frame has been handed over, of pictures that may still be in the making.
  void after_frame(const render::ShownPictures& shown);

 private:
  MirrorLink& link_;
  render::MirrorCopy copy_;
  render::MirrorPicture picture_;
  std::chrono::steady_clock::time_point next_;  // copy, not earlier
};

}  // namespace app
