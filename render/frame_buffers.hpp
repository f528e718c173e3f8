// The device memory of one size of frame, and the way of a finished view back to the host.
#pragma once

#include <cstddef>

#include "render/renderer.hpp"
#include "render/vk/buffer.hpp"

namespace render {

constexpr std::size_t kPixelBytes = 16, kWavefrontBytes = 32;  // see shaders/frame.h

// The buffers of one size of frame.
struct FrameBuffers {
  struct Size {
    std::size_t pixels = 0;  // of all views
    bool wavefront = false, sums = false;
    bool hits = false;  // what rays meet is found by a kernel of its own

    [[nodiscard]] bool holds(const Size& other) const {
      return pixels == other.pixels && wavefront >= other.wavefront && sums >= other.sums && hits >= other.hits;
    }
  };

  FrameBuffers(const vk::Device& device, const Size& s)
      : size(s),
        pixels(device, s.pixels * kPixelBytes, vk::Memory::device),
        keys(device, s.pixels * 8, vk::Memory::device),
        wavefronts(device, s.wavefront ? s.pixels * kWavefrontBytes : 16, vk::Memory::device),
        sums(device, s.sums ? s.pixels * 16 : 16, vk::Memory::device),
        ray_origins(device, s.hits ? s.pixels * 16 : 16, vk::Memory::device),
        ray_directions(device, s.hits ? s.pixels * 16 : 16, vk::Memory::device),
        hits(device, s.hits ? s.pixels * 4 : 4, vk::Memory::device),
        list(device, (s.pixels + 4) * 4, vk::Memory::device),
        doubtful(device, (s.pixels + 4) * 4, vk::Memory::device),
        blocks(device, s.pixels * 4, vk::Memory::device),
        radiance(device, s.pixels * 8, vk::Memory::device),
        display(device, s.pixels * 4, vk::Memory::device) {}

  Size size;
  vk::Buffer pixels, keys, wavefronts, sums, ray_origins, ray_directions, hits, list, doubtful, blocks, radiance,
      display;
};

// View `index` of a frame of config's size.
[[nodiscard]] RenderedView read_view(const FrameBuffers& frame, const FrameConfig& config, std::size_t index);

}  // namespace render
