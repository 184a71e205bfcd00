// SPDX-License-Identifier: Apache-2.0
// MosaicGrid divides the work on a plane that no machine holds into tiles, each of which a task
// codes from the samples around it.
//
// The plane has one transform, as every plane has. Its levels come in groups of three, as those of
// regions do (bitstream/track/track.hpp). The plane of group 0 is that of the samples; the plane of
// group g is the low band of level 3g. A tile is a rectangle of the plane of a group: its task
// codes the tracks of the regions in it, and hands the low band of three more levels to the tasks
// of the next group. The base, which holds all coarser levels, is the tile of the last group.
//
// Lifting has finite support, so that a task needs only the samples of its tile and of a halo
// around it, and its codewords are those of an encoder that has the whole plane. Analysis by a
// filter of steps with k weights each reaches R = the sum of 2k - 1 samples of the plane that a
// level splits, 18 at most; three levels reach 7 R of the group's plane. Synthesis undoes the same
// steps, and reaches as far.
//
// Where corrections follow a cut of the coefficients, a task has to know what a decoder makes of
// the cut. So tiles of further groups restore the planes again, from the base to the samples: they
// decode the tracks of the regions around a tile, above the low band that the group before has
// restored.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "base/view.hpp"
#include "bitstream/track/track.hpp"
#include "codec/wavelet/pyramid.hpp"

namespace tetrakis::inline mosaic {

/// Samples around a tile that its task reads: 7 * 18, rounded up to whole samples of the low band
/// of three levels. Less would change the codewords of the longest filter.
inline constexpr uint32_t kHalo = 128;

/// Sides of tiles, in samples of the plane of their group. Larger tiles read fewer samples twice
/// and take more memory; smaller ones keep more workers busy.
inline constexpr int kUsualTileLog2 = 12;

/// The tile in a column and a row of a group, which one task codes or restores.
struct Tile {
  int group = 0;
  uint32_t column = 0, row = 0;

  auto operator<=>(const Tile&) const = default;
};

class MosaicGrid {
 public:
  /// region_log2: as of a stream, at most tile_log2; 0: the base is the only tile. restores: there
  /// are tiles that restore planes.
  MosaicGrid(Extent plane, int region_log2, int tile_log2, bool restores = false);

  const Pyramid& pyramid() const { return pyramid_; }
  const std::vector<Region>& regions() const { return regions_; }
  /// Groups of regions. The base is the only tile of the group of this number.
  int groups() const { return static_cast<int>(groups_.size()); }
  bool isBase(const Tile& tile) const { return tile.group == groups(); }
  /// Groups of tiles that code. The tile of the next group restores the plane of the base, and
  /// those of each further group restore the plane of one group less.
  int codingGroups() const { return groups() + 1; }
  bool isRestoring(const Tile& tile) const { return tile.group >= codingGroups(); }
  /// The group whose plane the tile codes or restores.
  int planeGroup(const Tile& tile) const {
    return isRestoring(tile) ? 2 * groups() + 1 - tile.group : tile.group;
  }
  /// Whether its task reads samples of the source.
  bool readsSource(const Tile& tile) const { return planeGroup(tile) == 0; }
  /// Whether it leaves a low band for the tasks of the next group.
  bool leavesLow(const Tile& tile) const {
    return !isBase(tile) && !(isRestoring(tile) && planeGroup(tile) == 0);
  }
  /// The size of the plane of a group, and of that of the base.
  Extent plane(int group) const { return pyramid_.low(kRegionLevels * group).extent; }
  bool has(const Tile& tile) const;
  /// All tiles of all groups in their order: each comes behind those that it needs.
  std::vector<Tile> tiles() const;

  /// The samples of the tile, in the plane of its group.
  Window samples(const Tile& tile) const;
  /// The same with the halo; of a tile that restores, the regions that these samples meet.
  Window block(const Tile& tile) const;
  /// The levels that its task splits, or joins.
  int levels(const Tile& tile) const;
  /// The samples of a low band that the tile leaves. Where it codes, they are those of the next
  /// group's plane; where it restores, those of its own plane.
  Window low(const Tile& tile) const;
  /// The tiles whose parts the task reads: lowNeeds() and coders().
  std::vector<Tile> needs(const Tile& tile) const;
  /// The tiles of the group before whose low bands the task reads.
  std::vector<Tile> lowNeeds(const Tile& tile) const;
  /// The tiles that code the regions in the block of a tile that restores; none of other tiles.
  std::vector<Tile> coders(const Tile& tile) const;
  /// The tiles that code and leave the samples of a window of the plane of a group above 0.
  std::vector<Tile> leavers(int group, const Window& window) const;
  /// The window of the next group's plane that holds the low band of a window of whole regions.
  Window coarser(int group, const Window& window) const;
  /// The numbers of the tracks that the tile codes: of coefficients, or, where it restores samples,
  /// of corrections.
  std::vector<uint32_t> tracks(const Tile& tile) const;

 private:
  /// Regions and tiles of one group.
  struct Group {
    uint32_t first = 0;              ///< number of the track of the first region
    uint32_t columns = 0, rows = 0;  ///< of regions
  };

  /// The number of tiles along a side of `regions` regions. A remainder of less than half a tile
  /// joins its neighbour.
  uint32_t tilesOf(uint32_t regions) const;
  /// The regions of a column or row of tiles: the first, and the one behind the last.
  struct Range {
    uint32_t begin, end;
  };
  Range regionsOf(uint32_t tile, uint32_t regions) const;
  /// The samples around the regions that a window with its halo meets.
  Window wholeRegions(int group, const Window& window) const;
  /// The tiles of a group, row by row.
  std::vector<Tile> tilesOfGroup(int group) const;

  Pyramid pyramid_;
  std::vector<Region> regions_;
  std::vector<Group> groups_;  ///< the finest first
  int region_log2_;
  uint32_t per_tile_;  ///< regions along the side of a tile
  bool restores_;
};

}  // namespace tetrakis::inline mosaic
