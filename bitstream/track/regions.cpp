// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/regions.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline track {

namespace {

/// The regions of one group of levels. A remainder of less than half a side joins its neighbour.
struct Grid {
  int side_log2;
  uint32_t columns, rows;

  Grid(uint32_t width, uint32_t height, int log2)
      : side_log2(log2), columns(split(width, log2)), rows(split(height, log2)) {}

  bool single() const { return columns == 1 && rows == 1; }

  /// The rectangle of one region of a plane.
  Window rectangle(uint32_t column, uint32_t row, uint32_t width, uint32_t height) const {
    const uint32_t x = column << side_log2, y = row << side_log2;
    const uint32_t x1 = column + 1 == columns ? width : (column + 1) << side_log2;
    const uint32_t y1 = row + 1 == rows ? height : (row + 1) << side_log2;
    return {x, y, x1 - x, y1 - y};
  }

  /// The longest side of a region: the first one's, or the last one's with the remainder.
  static uint32_t longest(uint32_t side, int log2) {
    const uint64_t before = uint64_t{split(side, log2) - 1} << log2;
    return before == 0 ? side : std::max(uint32_t{1} << log2, static_cast<uint32_t>(side - before));
  }

 private:
  static uint32_t split(uint32_t side, int log2) {
    const uint64_t half = uint64_t{1} << (log2 - 1);
    return static_cast<uint32_t>(std::max<uint64_t>(1, (side + half) >> log2));
  }
};

/// The grids that are split, finest first.
std::vector<Grid> gridsOf(uint32_t width, uint32_t height, int side_log2) {
  std::vector<Grid> grids;
  if (side_log2 == 0) return grids;
  for (int log2 = side_log2;; log2 += kRegionLevels) {
    assert(log2 <= kMostRegionLog2 + 32);  // sides are 32-bit numbers: larger grids are single
    const Grid grid(width, height, log2);
    if (grid.single()) return grids;
    grids.push_back(grid);
  }
}

}  // namespace

std::vector<Region> regionsOf(uint32_t width, uint32_t height, int side_log2) {
  const std::vector<Grid> grids = gridsOf(width, height, side_log2);
  auto level = static_cast<int>(grids.size()) * kRegionLevels;
  std::vector<Region> regions;
  regions.reserve(regionCount(width, height, side_log2));
  regions.push_back({level + 1, Region::kAll, 0, 0, width, height});
  for (auto grid = grids.rbegin(); grid != grids.rend(); ++grid) {
    for (uint32_t y = 0; y < grid->rows; ++y) {
      for (uint32_t x = 0; x < grid->columns; ++x) {
        const Window r = grid->rectangle(x, y, width, height);
        regions.push_back(
            {level - kRegionLevels + 1, level, r.x, r.y, r.x + r.width, r.y + r.height});
      }
    }
    level -= kRegionLevels;
  }
  assert(regions.size() == regionCount(width, height, side_log2));
  return regions;
}

std::vector<Window> finestRegions(uint32_t width, uint32_t height, int side_log2) {
  std::vector<Window> regions;
  const std::vector<Grid> grids = gridsOf(width, height, side_log2);
  if (grids.empty()) return regions;
  const Grid& grid = grids.front();
  regions.reserve(size_t{grid.columns} * grid.rows);
  for (uint32_t y = 0; y < grid.rows; ++y) {
    for (uint32_t x = 0; x < grid.columns; ++x)
      regions.push_back(grid.rectangle(x, y, width, height));
  }
  return regions;
}

std::vector<Region> largestRegions(uint32_t width, uint32_t height, int side_log2) {
  const std::vector<Grid> grids = gridsOf(width, height, side_log2);
  std::vector<Region> regions;
  int level = 0;
  for (const Grid& grid : grids) {
    regions.push_back({level + 1, level + kRegionLevels, 0, 0, Grid::longest(width, grid.side_log2),
                       Grid::longest(height, grid.side_log2)});
    level += kRegionLevels;
  }
  regions.push_back({level + 1, Region::kAll, 0, 0, width, height});
  return regions;
}

uint64_t regionCount(uint32_t width, uint32_t height, int side_log2) {
  uint64_t count = 1;
  for (const Grid& grid : gridsOf(width, height, side_log2))
    count += uint64_t{grid.columns} * grid.rows;
  return count;
}

uint64_t finestRegionCount(uint32_t width, uint32_t height, int side_log2) {
  const std::vector<Grid> grids = gridsOf(width, height, side_log2);
  return grids.empty() ? 0 : uint64_t{grids.front().columns} * grids.front().rows;
}

}  // namespace tetrakis::inline track
