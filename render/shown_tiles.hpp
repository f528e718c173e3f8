// A picture by tiles of 8 x 8 pixels where nobody sees all of it: its kernels go through the list of those that are
// drawn, a workgroup each (shaders/group.glsl), so that the others cost nothing, whether the device skips branches or
// runs both of their sides.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracking/hidden_area.hpp"

namespace render {

constexpr int kShownTile = 8;                   // px a side
constexpr std::uint32_t kNoTile = 0xffffffffU;  // lies beyond every picture

struct TileLists {
  // A tile's column | row << 16. Those of which a pixel is seen come in the order in which the device's threads share
  // them out evenly; hidden ones row by row.
  std::vector<std::uint32_t> shown, hidden;
};

// threads: between how many the device divides a dispatch, each taking a run of workgroups; 1: it does not.
[[nodiscard]] TileLists tile_lists(const tracking::PixelMask& mask, int threads);

// Words from one view's list to the next in the buffer that kernels read.
[[nodiscard]] std::size_t listed_tile_words(int width, int height);
// The list filled up to that length with tiles that lie beyond every picture.
[[nodiscard]] std::vector<std::uint32_t> padded(std::vector<std::uint32_t> tiles, int width, int height);

// Workgroups x, y, z for a list of so many: at a tile each; then a word unused; then the same at sixteen each. As
// vkCmdDispatchIndirect takes them.
[[nodiscard]] std::array<std::uint32_t, 8> tile_counts(std::size_t tiles);
constexpr std::size_t kBlockCountsAt = 16;  // bytes, of the second

}  // namespace render
