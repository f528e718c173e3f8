// Which tiles are drawn of a picture that is not all seen, and how many workgroups that takes.
#include "render/shown_tiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace {

using tracking::PixelMask;

constexpr int kWidth = 43, kHeight = 29;  // 6 x 4 tiles, the last ones cut

PixelMask all_hidden() {
  return {kWidth, kHeight, std::vector<std::uint8_t>(kWidth * kHeight, 1)};
}

TEST(ShownTiles, ATileWithOneSeenPixelIsDrawnAndNoOther) {
  for (const int threads : {1, 2, 3, 64}) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        PixelMask mask = all_hidden();
        mask.hidden[static_cast<std::size_t>(y * kWidth + x)] = 0;
        const render::TileLists lists = render::tile_lists(mask, threads);
        ASSERT_EQ(lists.shown, (std::vector{static_cast<std::uint32_t>(x / 8 | y / 8 << 16)})) << x << " " << y;
        ASSERT_EQ(lists.hidden.size(), 23U);
      }
    }
  }
}

TEST(ShownTiles, EveryTileIsInOneOfTheListsOnce) {
  std::mt19937 random(5);
  PixelMask mask = all_hidden();
  for (int i = 0; i < 12; ++i) {
    mask.hidden[random() % mask.hidden.size()] = 0;
  }
  for (const int threads : {1, 2, 5}) {
    const render::TileLists lists = render::tile_lists(mask, threads);
    std::set<std::uint32_t> tiles(lists.shown.begin(), lists.shown.end());
    tiles.insert(lists.hidden.begin(), lists.hidden.end());
    EXPECT_EQ(lists.shown.size() + lists.hidden.size(), 24U);
    EXPECT_EQ(tiles.size(), 24U);
    EXPECT_FALSE(lists.shown.empty());
  }
}

// A device of two threads gives one the first half of a list: it gets every second row.
TEST(ShownTiles, RowsAreDealtOutBetweenThreads) {
  const PixelMask seen{kWidth, kHeight, std::vector<std::uint8_t>(kWidth * kHeight, 0)};
  const std::vector<std::uint32_t> tiles = render::tile_lists(seen, 2).shown;
  ASSERT_EQ(tiles.size(), 24U);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    EXPECT_EQ((tiles[i] >> 16U) % 2, i < 12 ? 0U : 1U) << i;
  }
}

// No device need take more than 65535 workgroups in x; every tile has one, and no group looks beyond the list.
TEST(ShownTiles, WorkgroupsCoverTheListAndStayWithinIt) {
  for (const int side : {8, 64, 1024, 2900}) {  // px; the last has 131,769 tiles
    const std::size_t all = static_cast<std::size_t>((side + 7) / 8) * static_cast<std::size_t>((side + 7) / 8);
    for (const std::size_t tiles : {std::size_t{0}, std::size_t{1}, all / 3, all - 1, all}) {
      const auto counts = render::tile_counts(tiles);
      EXPECT_LE(counts[0], 65535U);
      EXPECT_LE(counts[4], 65535U);
      const std::size_t groups = std::size_t{counts[0]} * counts[1] * counts[2];
      EXPECT_GE(groups, tiles);
      EXPECT_LE(groups, render::listed_tile_words(side, side));
      EXPECT_GE(std::size_t{16} * counts[4] * counts[5] * counts[6], tiles);
      EXPECT_LE(std::size_t{16} * counts[4], render::listed_tile_words(side, side));
      EXPECT_EQ(tiles == 0, groups == 0);
    }
  }
  const auto list = render::padded({7, 8}, 64, 64);
  EXPECT_EQ(list.size(), render::listed_tile_words(64, 64));
  EXPECT_EQ(list[1], 8U);
  EXPECT_TRUE(std::all_of(list.begin() + 2, list.end(), [](std::uint32_t tile) { return tile == ~0U; }));
}

}  // namespace
