#include "render/shown_tiles.hpp"

#include <algorithm>

namespace render {
namespace {

constexpr std::uint32_t kMostGroups = 65535;  // in x that every device allows
constexpr std::size_t kPadding = 16;          // beyond the last tile: rows of groups and groups of tiles are full

int along(int pixels) {
  return (pixels + kShownTile - 1) / kShownTile;
}

bool is_hidden(const tracking::PixelMask& mask, int tile_x, int tile_y) {
  for (int y = kShownTile * tile_y; y < std::min(kShownTile * (tile_y + 1), mask.height); ++y) {
    for (int x = kShownTile * tile_x; x < std::min(kShownTile * (tile_x + 1), mask.width); ++x) {
      if (!mask.at(x, y)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

TileLists tile_lists(const tracking::PixelMask& mask, int threads) {
  TileLists lists;
  for (int first = 0; first < threads; ++first) {
    for (int y = first; y < along(mask.height); y += threads) {
      for (int x = 0; x < along(mask.width); ++x) {
        const auto tile = static_cast<std::uint32_t>(x) | static_cast<std::uint32_t>(y) << 16U;
        (is_hidden(mask, x, y) ? lists.hidden : lists.shown).push_back(tile);
      }
    }
  }
  std::ranges::sort(lists.hidden, {}, [](std::uint32_t tile) { return tile >> 16U | tile << 16U; });
  return lists;
}

std::size_t listed_tile_words(int width, int height) {
  return static_cast<std::size_t>(along(width)) * static_cast<std::size_t>(along(height)) + kPadding;
}

std::vector<std::uint32_t> padded(std::vector<std::uint32_t> tiles, int width, int height) {
  tiles.resize(listed_tile_words(width, height), kNoTile);
  return tiles;
}

std::array<std::uint32_t, 8> tile_counts(std::size_t tiles) {
  const auto count = static_cast<std::uint32_t>(tiles);
  const std::uint32_t rows = (count + kMostGroups - 1) / kMostGroups;
  const std::uint32_t columns = rows == 0 ? 0 : (count + rows - 1) / rows;
  return {columns, rows, 1, 0, (count + 15) / 16, 1, 1, 0};
}

}  // namespace render
