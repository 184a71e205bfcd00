// SPDX-License-Identifier: Apache-2.0
// A priority map orders the coefficients of a plane over the ground: those of a tile of priority p
// come p bit-planes earlier than those of priority 0. Encoders make it from the pictures of
// cameras; without one all coefficients have priority 0. Magnitudes stay as they are, so that
// neighbours of two priorities can still be compared, as they cannot where magnitudes are shifted
// (the regions of interest of JPEG 2000). A coefficient has the mean priority of the tiles around
// it, so coarse levels need no rule of their own.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/coder/adaptive_bit.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "bitstream/track/band.hpp"

namespace tetrakis::inline wavelet {

/// Square tiles of the samples of a plane, the last of a row or column cut at its border.
struct PriorityMap {
  Extent plane;
  int tile_log2 = 0;                ///< sides of the tiles
  std::vector<uint8_t> priorities;  ///< row by row, each less than kPriorities; empty: no map

  bool empty() const { return priorities.empty(); }
  uint32_t columns() const { return tilesAlong(plane.width, tile_log2); }
  uint32_t rows() const { return tilesAlong(plane.height, tile_log2); }
};

/// What a squared error counts in each tier, so that it counts 1 in the mean over all tiles:
/// multiples of 4^priority.
std::array<double, kPriorities> worthOf(const PriorityMap& map);

/// The map that a header of a plane describes. Safe on any code.
PriorityMap priorityMapOf(const PriorityHeader& header, Extent plane);

/// The priorities of coefficients: means over the tiles around them.
class CoefficientPriorities {
 public:
  explicit CoefficientPriorities(const PriorityMap& map);

  /// The priority of a coefficient of a level whose sample lies at (x, y).
  uint8_t at(uint32_t x, uint32_t y, int level) const;
  /// Whether those of a row between two of them, and these, are means over the same tiles.
  bool alikeInRow(uint32_t x0, uint32_t x1, int level) const {
    return sameTiles(x0, x1, plane_.width, level);
  }
  /// Whether those of two rows are means over the same tiles.
  bool alikeRows(uint32_t y0, uint32_t y1, int level) const {
    return sameTiles(y0, y1, plane_.height, level);
  }

 private:
  bool sameTiles(uint32_t a, uint32_t b, uint32_t side, int level) const {
    return firstTile(a, level) == firstTile(b, level) &&
           endTile(a, side, level) == endTile(b, side, level);
  }
  /// What a coefficient changes lies mostly within half of its level's spacing.
  uint32_t firstTile(uint32_t place, int level) const {
    return (place - std::min(place, reachOf(level))) >> tile_log2_;
  }
  uint32_t endTile(uint32_t place, uint32_t side, int level) const {
    return (std::min(place + reachOf(level), side - 1) >> tile_log2_) + 1;
  }
  static uint32_t reachOf(int level) { return (uint32_t{1} << level) / 2; }

  Extent plane_;
  int tile_log2_;
  uint32_t stride_;
  /// [y * stride_ + x]: the sum of 4^priority of all tiles above and left of the tile (x, y).
  std::vector<uint64_t> sums_;
};

// PriorityPass codes a priority map, tile by tile. It asks whether a tile has the priority that its
// neighbours predict (the median of the western one, the northern one and the plane through both:
// M. J. Weinberger et al., "LOCO-I", 1996), and else how far above or below the priority is.

/// Io: bitstream/coder/range_decoder.hpp, range_encoder.hpp.
template <class Io>
class PriorityPass {
 public:
  explicit PriorityPass(Io& io) : io_(io) {}

  /// priorities: of the encoder the map, of the decoder as many zeros, which it fills up to the
  /// first decision that does not count.
  void run(uint32_t columns, std::span<uint8_t> priorities) {
    for (size_t i = 0; i < priorities.size(); ++i) {
      const int priority = tile(expect(columns, priorities, i), priorities[i]);
      if (io_.stopped()) return;
      priorities[i] = static_cast<uint8_t>(priority);
    }
  }

 private:
  static constexpr int kHighest = int{kPriorities} - 1;
  static constexpr size_t kBusy = 3;  ///< how much the neighbours differ

  struct Expected {
    int priority;
    size_t busy;
  };

  static Expected expect(uint32_t columns, std::span<const uint8_t> priorities, size_t i) {
    const bool has_west = i % columns > 0, has_north = i >= columns;
    int west = has_west ? priorities[i - 1] : 0;
    int north = has_north ? priorities[i - columns] : west;
    if (!has_west) west = north;
    const int beyond = has_west && has_north ? priorities[i - columns - 1] : north;
    const int slope = west + north - beyond;
    const int least = std::min(west, north), most = std::max(west, north);
    const auto differ = static_cast<size_t>(std::abs(west - beyond) + std::abs(north - beyond));
    return {std::clamp(slope, least, most), std::min(differ, kBusy - 1)};
  }

  /// wanted: of the encoder the priority.
  int tile(const Expected& expected, int wanted) {
    const auto& [priority, busy] = expected;
    if (io_.decide(same_[busy], wanted == priority) || io_.stopped()) return priority;
    const bool either = priority > 0 && priority < kHighest;
    const bool up = either ? io_.decide(up_[busy], wanted > priority) : priority == 0;
    const int room = up ? kHighest - priority : priority;
    int off = 1;
    while (off < room &&
           io_.decide(more_[static_cast<size_t>(off)], std::abs(wanted - priority) > off))
      ++off;
    return up ? priority + off : priority - off;
  }

  Io& io_;
  std::array<AdaptiveBit, kBusy> same_, up_;
  std::array<AdaptiveBit, kPriorities> more_;
};

// headerOf() codes a priority map as the part of the header that holds it.

/// The header that stands for a map; an empty one for a map without tiles.
PriorityHeader headerOf(const PriorityMap& map);

}  // namespace tetrakis::inline wavelet
