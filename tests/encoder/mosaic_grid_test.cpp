// SPDX-License-Identifier: Apache-2.0
// Tiles cover the planes of all groups once, and low bands those of the next ones.
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "encoder/mosaic/mosaic_grid.hpp"

namespace tetrakis::test {
namespace {

struct GridCase {
  Extent plane;
  int region_log2, tile_log2;
};
const GridCase kGrids[] = {{{1, 1}, 0, 4},       {{3, 900}, 4, 5},    {{900, 3}, 4, 4},
                           {{24, 24}, 4, 4},     {{255, 257}, 4, 6},  {{1000, 700}, 5, 7},
                           {{4096, 4096}, 6, 8}, {{777, 4321}, 4, 9}, {{2049, 65}, 4, 4}};

void mark(const Window& window, Extent plane, std::vector<int>& times) {
  ASSERT_TRUE(window.isInside(plane));
  for (uint32_t y = window.y; y < window.y + window.height; ++y)
    for (uint32_t x = window.x; x < window.x + window.width; ++x)
      ++times[size_t{y} * plane.width + x];
}

TEST(MosaicGrid, TilesCoverEveryPlaneOnce) {
  for (const GridCase& given : kGrids) {
    const MosaicGrid grid(given.plane, given.region_log2, given.tile_log2);
    for (int group = 0; group <= grid.groups(); ++group) {
      const Extent plane = grid.plane(group);
      std::vector<int> times(plane.samples());
      for (const Tile& tile : grid.tiles())
        if (tile.group == group) mark(grid.samples(tile), plane, times);
      EXPECT_EQ(times, std::vector<int>(plane.samples(), 1)) << given.plane.width << " " << group;
    }
  }
}

TEST(MosaicGrid, LowBandsCoverTheNextPlaneOnce) {
  for (const GridCase& given : kGrids) {
    const MosaicGrid grid(given.plane, given.region_log2, given.tile_log2);
    for (int group = 0; group < grid.groups(); ++group) {
      const Extent plane = grid.plane(group + 1);
      std::vector<int> times(plane.samples());
      for (const Tile& tile : grid.tiles())
        if (tile.group == group) mark(grid.low(tile), plane, times);
      EXPECT_EQ(times, std::vector<int>(plane.samples(), 1)) << given.plane.width << " " << group;
    }
  }
}

TEST(MosaicGrid, EveryTrackBelongsToOneTile) {
  for (const GridCase& given : kGrids) {
    const MosaicGrid grid(given.plane, given.region_log2, given.tile_log2);
    std::vector<int> times(grid.regions().size());
    for (const Tile& tile : grid.tiles()) {
      ASSERT_TRUE(grid.has(tile));
      for (const uint32_t track : grid.tracks(tile)) {
        ++times[track];
        const Region& region = grid.regions()[track];
        EXPECT_EQ(region.isBase(), grid.isBase(tile));
        if (region.isBase()) continue;
        EXPECT_EQ(region.first_level, kRegionLevels * tile.group + 1);
        const Window samples = grid.samples(tile);
        EXPECT_GE(region.x0, samples.x << (kRegionLevels * tile.group));
        EXPECT_GE(region.y0, samples.y << (kRegionLevels * tile.group));
      }
    }
    EXPECT_EQ(times, std::vector<int>(times.size(), 1));
  }
}

TEST(MosaicGrid, TilesStandBehindThoseThatTheyNeed) {
  for (const GridCase& given : kGrids) {
    const MosaicGrid grid(given.plane, given.region_log2, given.tile_log2);
    std::set<Tile> before;
    for (const Tile& tile : grid.tiles()) {
      for (const Tile& needed : grid.needs(tile)) EXPECT_TRUE(before.contains(needed));
      before.insert(tile);
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
