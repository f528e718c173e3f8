// The device memory of one size of frame, and the way of a finished view back to the host.
#pragma once

#include <cstddef>

#include "render/renderer.hpp"
#include "render/vk/buffer.hpp"

namespace render {

constexpr std::size_t kPixelBytes = 16, kWavefrontBytes = 32;  // see shaders/frame.h

// The buffers of one size of frame.
struct FrameBuffers {
  FrameBuffers(const vk::Device& device, std::size_t pixel_count, bool wavefront, bool sums, bool tile)
      : count(pixel_count),
        has_wavefront(wavefront),
        has_sums(sums),
        has_tile(tile),
        pixels(device, count * kPixelBytes, vk::Memory::device),
        keys(device, count * 4, vk::Memory::device),
        wavefronts(device, wavefront ? count * kWavefrontBytes : 16, vk::Memory::device),
        sums(device, sums ? count * 16 : 16, vk::Memory::device),
        ray_origins(device, tile ? count * kPixelBytes : 16, vk::Memory::device),
        ray_directions(device, tile ? count * kPixelBytes : 16, vk::Memory::device),
        tile_hits(device, tile ? count * 4 : 4, vk::Memory::device),
        list(device, (count + 1) * 4, vk::Memory::device),
        radiance(device, count * 8, vk::Memory::device),
        display(device, count * 4, vk::Memory::device) {}

  std::size_t count;
  bool has_wavefront, has_sums, has_tile;
  vk::Buffer pixels, keys, wavefronts, sums, ray_origins, ray_directions, tile_hits, list, radiance, display;
};

// View `index` of a frame of config's size.
[[nodiscard]] RenderedView read_view(const FrameBuffers& frame, const FrameConfig& config, std::size_t index);

}  // namespace render
