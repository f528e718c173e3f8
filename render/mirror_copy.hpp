// What all eyes are shown, side by side and made small, brought to the host for somebody beside the headset. It is made
// behind the headset's frame on the same queue, and the host waits for nothing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/vk/external.hpp"
#include "render/vk/kernel.hpp"

namespace render {

// Display-encoded sRGB, a word a pixel, red in its lowest byte, top row first.
struct MirrorPicture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels = {};
};

// Pictures of one size, one an eye from left to right, each made of blocks: x and y in its own picture.
struct ShownPictures {
  std::vector<std::vector<vk::PixelBlock>> eyes;
  int width = 0, height = 0;  // of each
  bool blue_first = false;
};

class MirrorCopy {
 public:
  // Refers to the device.
  explicit MirrorCopy(const vk::Device& device);

  // The largest copy of pictures of this size that fits the room, 0 x 0 where none does. Never enlarged.
  [[nodiscard]] static std::array<int, 2> size_in(const ShownPictures& shown, const std::array<int, 2>& room);

  // Submits a copy, of a size from size_in(), of what the blocks will hold once all that was submitted before is done.
  // Only while none is under way.
  void start(const ShownPictures& shown, const std::array<int, 2>& size);
  [[nodiscard]] bool is_under_way() const { return size_[0] > 0; }

  // The copy that is under way into `picture`, once it is done; false before.
  bool take(MirrorPicture& picture);

 private:
  const vk::Device& device_;
  vk::Kernel shrink_;
  vk::Buffer pixels_;
  std::array<int, 2> size_{};  // of the copy under way; 0: none is
  vk::Submission submission_;  // last: it waits for the above
};

}  // namespace render
