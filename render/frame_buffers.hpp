// The device memory of one size of frame, and the way of a finished view back to the host.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "render/frame_types.hpp"
#include "render/renderer.hpp"
#include "render/vk/buffer.hpp"

namespace render {

constexpr std::size_t kPixelBytes = 16, kWavefrontBytes = 32, kTransferBytes = 64, kCornerBytes = 96,
                      kShownCountsBytes = 32,  // see shaders/frame.h and shown_tiles.hpp
    kRoughCountsBytes = 16;                    // shaders/find_rough.comp.glsl

// The buffers of one size of frame.
struct FrameBuffers {
  struct Size {
    std::size_t pixels = 0;  // of all views
    bool wavefront = false, sums = false;
    bool hits = false;             // what rays meet is found by a kernel of its own
    bool transfers = false;        // rays leave their ray-transfer matrices
    std::size_t corner_rays = 0;   // of interpolated lens rays, of all views
    std::size_t cubic_tiles = 0;   // words of the lists of tiles whose rays may be cubics; 0: none may
    std::size_t blur_tiles = 0;    // of one view; 0: nothing is blurred
    std::size_t listed_tiles = 0;  // words of the lists of tiles that are drawn (shown_tiles.hpp); 0: all are

    [[nodiscard]] bool holds(const Size& other) const {
      return pixels == other.pixels && wavefront >= other.wavefront && sums >= other.sums && hits >= other.hits &&
             transfers >= other.transfers && corner_rays >= other.corner_rays && cubic_tiles >= other.cubic_tiles &&
             blur_tiles >= other.blur_tiles && listed_tiles == other.listed_tiles;
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
        transfers(device, s.transfers ? s.pixels * kTransferBytes : 16, vk::Memory::device),
        corners(device, std::max<std::size_t>(s.corner_rays, 1) * kCornerBytes, vk::Memory::device),
        smooth_tiles(device, std::max<std::size_t>(s.cubic_tiles, 4) * 4, vk::Memory::device),
        rough_tiles(device, std::max<std::size_t>(s.cubic_tiles, 4) * 4, vk::Memory::device),
        rough_counts(device, kRoughCountsBytes * static_cast<std::size_t>(gpu::kMostViews), vk::Memory::device),
        list(device, (std::max(s.pixels, s.corner_rays) + 4) * 4, vk::Memory::device),
        doubtful(device, (s.pixels + 4) * 4, vk::Memory::device),
        blocks(device, s.pixels * 4, vk::Memory::device),
        blur_tiles(device, s.blur_tiles * 16, vk::Memory::device),
        blur_wide(device, 16, vk::Memory::device),
        blur_layered(device, (s.blur_tiles + 4) * 4, vk::Memory::device),
        blur_wide_layered(device, (s.blur_tiles + 4) * 4, vk::Memory::device),
        blur_blurred(device, (s.blur_tiles + 4) * 4, vk::Memory::device),
        blur_narrow(device, (s.blur_tiles + 4) * 4, vk::Memory::device),
        blur_squared(device, (s.blur_tiles + 4) * 4, vk::Memory::device),
        blur_reaches(device, s.blur_tiles * 8, vk::Memory::device),
        blur_sources(device, s.blur_tiles * 4, vk::Memory::device),
        blur_levels(device, s.blur_tiles * gpu::kWideTexels * 16, vk::Memory::device),
        blur_squares(device, s.blur_tiles * 16 * 8, vk::Memory::device),
        shown_tiles(device, std::max<std::size_t>(s.listed_tiles, 4) * 4, vk::Memory::device),
        shown_counts(device, kShownCountsBytes * static_cast<std::size_t>(gpu::kMostViews), vk::Memory::device),
        radiance(device, s.pixels * 8, vk::Memory::device),
        display(device, s.pixels * 4, vk::Memory::device) {}

  Size size;
  vk::Buffer pixels, keys, wavefronts, sums, ray_origins, ray_directions, hits, transfers, corners, smooth_tiles,
      rough_tiles, rough_counts, list, doubtful, blocks, blur_tiles, blur_wide, blur_layered, blur_wide_layered,
      blur_blurred, blur_narrow, blur_squared, blur_reaches, blur_sources, blur_levels, blur_squares, shown_tiles,
      shown_counts, radiance, display;
  std::vector<std::byte> corners_of;  // what the corners hold was traced for: see corner_key()
  int samples = 0;                    // in sums
};

// View `index` of a frame of config's size: one buffer of it, or all that the settings keep.
[[nodiscard]] Image8 read_display(const vk::Buffer& display, const FrameConfig& config, std::size_t index);
[[nodiscard]] std::vector<float> read_radiance(const vk::Buffer& radiance, const FrameConfig& config,
                                               std::size_t index);
[[nodiscard]] WavefrontPlanes read_wavefronts(const vk::Buffer& wavefronts, const FrameConfig& config,
                                              std::size_t index);
[[nodiscard]] RenderedView read_view(const FrameBuffers& frame, const FrameConfig& config, std::size_t index);

}  // namespace render
