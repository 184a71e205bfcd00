// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/mosaic_grid.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline mosaic {

MosaicGrid::MosaicGrid(Extent plane, int region_log2, int tile_log2)
    : pyramid_(plane),
      regions_(tetrakis::regionsOf(plane.width, plane.height, region_log2)),
      region_log2_(region_log2),
      per_tile_(uint32_t{1} << (tile_log2 - region_log2)) {
  assert(region_log2 == 0 || region_log2 >= kLeastRegionLog2);
  assert(region_log2 <= tile_log2);
  for (uint32_t i = 1; i < regions_.size(); ++i) {
    const Region& region = regions_[i];
    if (region.x0 == 0 && region.y0 == 0) groups_.push_back({i, 0, 0});
    Group& group = groups_.back();
    if (region.y0 == 0) ++group.columns;
    if (region.x0 == 0) ++group.rows;
  }
  std::reverse(groups_.begin(), groups_.end());  // tracks begin with the coarsest group
}

uint32_t MosaicGrid::tilesOf(uint32_t regions) const {
  return std::max(1u, (regions + per_tile_ / 2) / per_tile_);
}

MosaicGrid::Range MosaicGrid::regionsOf(uint32_t tile, uint32_t regions) const {
  const bool last = tile + 1 == tilesOf(regions);
  return {tile * per_tile_, last ? regions : (tile + 1) * per_tile_};
}

bool MosaicGrid::has(const Tile& tile) const {
  if (isBase(tile)) return tile.column == 0 && tile.row == 0;
  if (tile.group < 0 || tile.group > groups()) return false;
  const Group& group = groups_[static_cast<size_t>(tile.group)];
  return tile.column < tilesOf(group.columns) && tile.row < tilesOf(group.rows);
}

std::vector<Tile> MosaicGrid::tiles() const {
  std::vector<Tile> tiles;
  for (int g = 0; g < groups(); ++g) {
    const Group& group = groups_[static_cast<size_t>(g)];
    for (uint32_t row = 0; row < tilesOf(group.rows); ++row)
      for (uint32_t column = 0; column < tilesOf(group.columns); ++column)
        tiles.push_back({g, column, row});
  }
  tiles.push_back({groups(), 0, 0});
  return tiles;
}

Window MosaicGrid::samples(const Tile& tile) const {
  const Extent plane = this->plane(tile.group);
  if (isBase(tile)) return {0, 0, plane.width, plane.height};
  const Group& group = groups_[static_cast<size_t>(tile.group)];
  const auto side = [&](Range range, uint32_t regions, uint32_t samples) {
    const uint32_t end = range.end == regions ? samples : range.end << region_log2_;
    return Range{range.begin << region_log2_, end};
  };
  const Range x = side(regionsOf(tile.column, group.columns), group.columns, plane.width);
  const Range y = side(regionsOf(tile.row, group.rows), group.rows, plane.height);
  return {x.begin, y.begin, x.end - x.begin, y.end - y.begin};
}

Window MosaicGrid::block(const Tile& tile) const {
  const Window inner = samples(tile);
  const Extent plane = this->plane(tile.group);
  const auto side = [](uint32_t begin, uint32_t length, uint32_t most) {
    const uint32_t from = begin - std::min(begin, kHalo);
    const auto end =
        static_cast<uint32_t>(std::min<uint64_t>(most, uint64_t{begin} + length + kHalo));
    return Range{from, end};
  };
  const Range x = side(inner.x, inner.width, plane.width);
  const Range y = side(inner.y, inner.height, plane.height);
  return {x.begin, y.begin, x.end - x.begin, y.end - y.begin};
}

int MosaicGrid::levels(const Tile& tile) const {
  const int coarser = pyramid_.levels() - kRegionLevels * tile.group;
  return isBase(tile) ? coarser : kRegionLevels;
}

Window MosaicGrid::low(const Tile& tile) const {
  assert(!isBase(tile));
  const Window inner = samples(tile);
  const Extent plane = this->plane(tile.group), next = this->plane(tile.group + 1);
  // A side that is not split, or not three times, is the whole side of one tile.
  const auto side = [](uint32_t begin, uint32_t length, uint32_t all, uint32_t coarse) {
    const uint32_t from = begin >> kRegionLevels;
    return Range{from, begin + length == all ? coarse : (begin + length) >> kRegionLevels};
  };
  const Range x = side(inner.x, inner.width, plane.width, next.width);
  const Range y = side(inner.y, inner.height, plane.height, next.height);
  return {x.begin, y.begin, x.end - x.begin, y.end - y.begin};
}

std::vector<Tile> MosaicGrid::needs(const Tile& tile) const {
  std::vector<Tile> needed;
  if (tile.group == 0) return needed;
  const int before = tile.group - 1;
  const Window block = this->block(tile);
  const Group& group = groups_[static_cast<size_t>(before)];
  for (uint32_t row = 0; row < tilesOf(group.rows); ++row) {
    for (uint32_t column = 0; column < tilesOf(group.columns); ++column) {
      const Tile finer{before, column, row};
      if (low(finer).meets(block)) needed.push_back(finer);
    }
  }
  return needed;
}

std::vector<uint32_t> MosaicGrid::tracks(const Tile& tile) const {
  if (isBase(tile)) return {0};
  const Group& group = groups_[static_cast<size_t>(tile.group)];
  const Range columns = regionsOf(tile.column, group.columns),
              rows = regionsOf(tile.row, group.rows);
  std::vector<uint32_t> tracks;
  for (uint32_t row = rows.begin; row < rows.end; ++row)
    for (uint32_t column = columns.begin; column < columns.end; ++column)
      tracks.push_back(group.first + row * group.columns + column);
  return tracks;
}

}  // namespace tetrakis::inline mosaic
