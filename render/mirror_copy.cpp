#include "render/mirror_copy.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "render/frame_types.hpp"
#include "shaders/shrink.hpp"

namespace render {
namespace {

constexpr int kGroup = 8;

// The first pixel of the copy whose footprint begins at or behind this pixel of the whole.
int first_at(int pixel, int whole, int copy) {
  return static_cast<int>((static_cast<std::int64_t>(pixel) * copy + whole - 1) / whole);
}

gpu::ShrinkBlock block_of(const vk::PixelBlock& block, int left, const ShownPictures& shown,
                          const std::array<int, 2>& copy) {
  const int across = shown.width * static_cast<int>(shown.eyes.size());
  const int x = first_at(left + block.x, across, copy[0]);
  const int y = first_at(block.y, shown.height, copy[1]);
  return {.source = {static_cast<int>(block.offset / 4), block.row_pixels, shown.blue_first ? 1 : 0, 0},
          .place = {left + block.x, block.y, block.width, block.height},
          .sizes = {across, shown.height, copy[0], copy[1]},
          .target = {x, y, first_at(left + block.x + block.width, across, copy[0]) - x,
                     first_at(block.y + block.height, shown.height, copy[1]) - y}};
}

}  // namespace

MirrorCopy::MirrorCopy(const vk::Device& device)
    : device_(device),
      shrink_(device, shaders::shrink, std::array{vk::Binding::storage_buffer, vk::Binding::storage_buffer},
              sizeof(gpu::ShrinkBlock), {}, "shrink"),
      pixels_(device, 0, vk::Memory::readback),
      submission_(device) {}

std::array<int, 2> MirrorCopy::size_in(const ShownPictures& shown, const std::array<int, 2>& room) {
  const auto eyes = static_cast<int>(shown.eyes.size());
  if (eyes == 0 || room[0] < eyes || room[1] < 1) {
    return {0, 0};
  }
  const double scale =
      std::min({1.0, static_cast<double>(room[0]) / (eyes * shown.width), static_cast<double>(room[1]) / shown.height});
  return {eyes * std::max(1, static_cast<int>(scale * shown.width)),
          std::max(1, static_cast<int>(std::lround(scale * shown.height)))};
}

void MirrorCopy::start(const ShownPictures& shown, const std::array<int, 2>& size) {
  if (is_under_way() || size[0] <= 0 || size[1] <= 0) {
    throw std::invalid_argument("one copy at a time, and one of some size");
  }
  const std::size_t bytes = 4 * static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  if (pixels_.bytes() < bytes) {
    pixels_ = vk::Buffer(device_, bytes, vk::Memory::readback);
  }
  vk::Commands copy(device_);
  for (std::size_t eye = 0; eye < shown.eyes.size(); ++eye) {
    for (const vk::PixelBlock& each : shown.eyes[eye]) {
      const gpu::ShrinkBlock block = block_of(each, static_cast<int>(eye) * shown.width, shown, size);
      if (block.target.z > 0 && block.target.w > 0) {
        copy.dispatch(shrink_, {each.from, &pixels_}, vk::bytes_of(block),
                      static_cast<std::uint32_t>((block.target.z + kGroup - 1) / kGroup),
                      static_cast<std::uint32_t>((block.target.w + kGroup - 1) / kGroup));
      }
    }
  }
  vk::Commands* const list = &copy;
  submission_.start({&list, 1});
  size_ = size;
}

bool MirrorCopy::take(MirrorPicture& picture) {
  if (!is_under_way() || !submission_.is_done()) {
    return false;
  }
  (void)submission_.wait();
  picture.width = size_[0];
  picture.height = size_[1];
  picture.pixels.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]));
  pixels_.read_bytes(std::as_writable_bytes(std::span(picture.pixels)));
  size_ = {};
  return true;
}

}  // namespace render
