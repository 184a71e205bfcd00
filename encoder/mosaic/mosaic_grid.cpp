// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/mosaic_grid.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline mosaic {

MosaicGrid::MosaicGrid(Extent plane, int region_log2, int tile_log2, bool restores)
    : pyramid_(plane),
      regions_(tetrakis::regionsOf(plane.width, plane.height, region_log2)),
      region_log2_(region_log2),
      per_tile_(uint32_t{1} << (tile_log2 - region_log2)),
      restores_(restores) {
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
  const int last = restores_ ? 2 * groups() + 1 : groups();
  if (tile.group < 0 || tile.group > last) return false;
  const int of_plane = planeGroup(tile);
  if (of_plane == groups()) return tile.column == 0 && tile.row == 0;
  const Group& group = groups_[static_cast<size_t>(of_plane)];
  return tile.column < tilesOf(group.columns) && tile.row < tilesOf(group.rows);
}

std::vector<Tile> MosaicGrid::tilesOfGroup(int group) const {
  const int of_plane = planeGroup({group});
  if (of_plane == groups()) return {{group, 0, 0}};
  const Group& regions = groups_[static_cast<size_t>(of_plane)];
  std::vector<Tile> tiles;
  for (uint32_t row = 0; row < tilesOf(regions.rows); ++row)
    for (uint32_t column = 0; column < tilesOf(regions.columns); ++column)
      tiles.push_back({group, column, row});
  return tiles;
}

std::vector<Tile> MosaicGrid::tiles() const {
  std::vector<Tile> tiles;
  for (int group = 0; has({group}); ++group) {
    const std::vector<Tile> of_group = tilesOfGroup(group);
    tiles.insert(tiles.end(), of_group.begin(), of_group.end());
  }
  return tiles;
}

Window MosaicGrid::samples(const Tile& tile) const {
  const int of_plane = planeGroup(tile);
  const Extent plane = this->plane(of_plane);
  if (of_plane == groups()) return {0, 0, plane.width, plane.height};
  const Group& group = groups_[static_cast<size_t>(of_plane)];
  const auto side = [&](Range range, uint32_t regions, uint32_t samples) {
    const uint32_t end = range.end == regions ? samples : range.end << region_log2_;
    return Range{range.begin << region_log2_, end};
  };
  const Range x = side(regionsOf(tile.column, group.columns), group.columns, plane.width);
  const Range y = side(regionsOf(tile.row, group.rows), group.rows, plane.height);
  return {x.begin, y.begin, x.end - x.begin, y.end - y.begin};
}

Window MosaicGrid::wholeRegions(int group, const Window& window) const {
  const Extent plane = this->plane(group);
  const Group& regions = groups_[static_cast<size_t>(group)];
  const auto side = [&](uint32_t begin, uint32_t length, uint32_t count, uint32_t all) {
    const uint32_t last = std::min((begin + length - 1) >> region_log2_, count - 1);
    return Range{std::min(begin >> region_log2_, count - 1) << region_log2_,
                 last + 1 == count ? all : (last + 1) << region_log2_};
  };
  const Range x = side(window.x, window.width, regions.columns, plane.width);
  const Range y = side(window.y, window.height, regions.rows, plane.height);
  return {x.begin, y.begin, x.end - x.begin, y.end - y.begin};
}

Window MosaicGrid::block(const Tile& tile) const {
  const int of_plane = planeGroup(tile);
  const Window inner = samples(tile);
  const Extent plane = this->plane(of_plane);
  const auto side = [](uint32_t begin, uint32_t length, uint32_t most) {
    const uint32_t from = begin - std::min(begin, kHalo);
    const auto end =
        static_cast<uint32_t>(std::min<uint64_t>(most, uint64_t{begin} + length + kHalo));
    return Range{from, end};
  };
  const Range x = side(inner.x, inner.width, plane.width);
  const Range y = side(inner.y, inner.height, plane.height);
  const Window with_halo{x.begin, y.begin, x.end - x.begin, y.end - y.begin};
  return isRestoring(tile) && of_plane < groups() ? wholeRegions(of_plane, with_halo) : with_halo;
}

int MosaicGrid::levels(const Tile& tile) const {
  const int of_plane = planeGroup(tile);
  const int coarser = pyramid_.levels() - kRegionLevels * of_plane;
  return of_plane == groups() ? coarser : kRegionLevels;
}

Window MosaicGrid::coarser(int group, const Window& window) const {
  const Extent plane = this->plane(group), next = this->plane(group + 1);
  // A side that is not split, or not three times, is the whole side of one tile.
  const auto side = [](uint32_t begin, uint32_t length, uint32_t all, uint32_t coarse) {
    const uint32_t from = begin >> kRegionLevels;
    return Range{from, begin + length == all ? coarse : (begin + length) >> kRegionLevels};
  };
  const Range x = side(window.x, window.width, plane.width, next.width);
  const Range y = side(window.y, window.height, plane.height, next.height);
  return {x.begin, y.begin, x.end - x.begin, y.end - y.begin};
}

Window MosaicGrid::low(const Tile& tile) const {
  assert(leavesLow(tile));
  return isRestoring(tile) ? samples(tile) : coarser(tile.group, samples(tile));
}

std::vector<Tile> MosaicGrid::leavers(int group, const Window& window) const {
  std::vector<Tile> tiles = tilesOfGroup(group - 1);
  std::erase_if(tiles, [&](const Tile& finer) { return !low(finer).meets(window); });
  return tiles;
}

std::vector<Tile> MosaicGrid::lowNeeds(const Tile& tile) const {
  if (tile.group == 0 || tile.group == codingGroups()) return {};
  if (!isRestoring(tile)) return leavers(tile.group, block(tile));
  const Window low = coarser(planeGroup(tile), block(tile));
  std::vector<Tile> tiles = tilesOfGroup(tile.group - 1);
  std::erase_if(tiles, [&](const Tile& before) { return !samples(before).meets(low); });
  return tiles;
}

std::vector<Tile> MosaicGrid::coders(const Tile& tile) const {
  if (!isRestoring(tile)) return {};
  std::vector<Tile> tiles = tilesOfGroup(planeGroup(tile));
  std::erase_if(tiles, [&](const Tile& coder) { return !samples(coder).meets(block(tile)); });
  return tiles;
}

std::vector<Tile> MosaicGrid::needs(const Tile& tile) const {
  std::vector<Tile> needed = lowNeeds(tile);
  const std::vector<Tile> coded = coders(tile);
  needed.insert(needed.end(), coded.begin(), coded.end());
  return needed;
}

std::vector<uint32_t> MosaicGrid::tracks(const Tile& tile) const {
  if (isBase(tile)) return {0};
  const int of_plane = planeGroup(tile);
  if (isRestoring(tile) && of_plane > 0) return {};
  const Group& group = groups_[static_cast<size_t>(of_plane)];
  const Range columns = regionsOf(tile.column, group.columns),
              rows = regionsOf(tile.row, group.rows);
  // Tracks of corrections follow those of all coefficients.
  const uint32_t first = isRestoring(tile) ? static_cast<uint32_t>(regions_.size()) : group.first;
  std::vector<uint32_t> tracks;
  for (uint32_t row = rows.begin; row < rows.end; ++row)
    for (uint32_t column = columns.begin; column < columns.end; ++column)
      tracks.push_back(first + row * group.columns + column);
  return tracks;
}

}  // namespace tetrakis::inline mosaic
