// SPDX-License-Identifier: Apache-2.0
// A Band holds what is known of one band of transform coefficients while its bit-planes arrive.
//
// It is a structure of arrays with a margin of zeros, so that neighbours need no bounds checks.
// Sets of coefficients (significant, visited in this plane) are bit maps, one word for each 32
// columns: a pass finds its coefficients by word operations and skips the others. Coefficients that
// do not exist, because their sample is void, count as visited from the start of every plane.
//
// Most bands of a large plane hold nothing for long. What takes bytes for each coefficient is
// allocated when the first significant one follows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/zeroed_array.hpp"

namespace tetrakis::inline track {

/// Direction of a band's detail; LL has none.
enum class Orientation : uint8_t { kLL, kHL, kLH, kHH };

struct BandShape {
  uint32_t rows = 0, columns = 0;

  bool empty() const { return rows == 0 || columns == 0; }
  uint32_t words() const { return (columns + 31) / 32; }  ///< of a row of a bit map
  uint32_t wordStride() const { return words() + 2; }
  /// Bit maps have margins of one word and as many rows as significantWithin() looks away.
  static constexpr uint32_t kMarginRows = 3;
  size_t wordCells() const { return size_t{rows + 2 * kMarginRows} * wordStride(); }
  size_t word(uint32_t row, uint32_t index) const {
    return size_t{row + kMarginRows} * wordStride() + index + 1;
  }
  /// Rows are padded to whole words and a margin of one cell.
  uint32_t stride() const { return 32 * words() + 2; }
  size_t cells() const { return size_t{rows + 2} * stride(); }
  size_t cell(uint32_t row, uint32_t column) const {
    return size_t{row + 1} * stride() + column + 1;
  }
  /// The columns of a word that exist.
  uint32_t valid(uint32_t index) const {
    const uint32_t left = columns - 32 * index;
    return left >= 32 ? ~uint32_t{0} : (uint32_t{1} << left) - 1;
  }
};

/// Neighbours of a cell. near[0..1] lie along the direction in which the band is high (the rows of
/// HL, the columns of LH), near[2..3] across it: coefficients of both bands then look alike.
struct Neighbours {
  std::array<ptrdiff_t, 4> near;
  std::array<ptrdiff_t, 4> far;  ///< the diagonals

  Neighbours(const BandShape& shape, Orientation orientation) {
    const auto row = static_cast<ptrdiff_t>(shape.stride());
    const ptrdiff_t along = orientation == Orientation::kLH ? row : 1, across = row + 1 - along;
    near = {-along, along, -across, across};
    far = {-row - 1, row + 1, -row + 1, row - 1};
  }
};

/// How many priorities a coefficient may have (codec/wavelet/priority_map.hpp). A band has a tier
/// for each: tier t holds the coefficients of priority t, which have passes of their own.
inline constexpr size_t kPriorities = 8;

/// What the passes over a tier have found so far.
struct TierState {
  int plane = 31;                  ///< bit-plane of the last pass; nothing is known below
  bool nonzero = false;            ///< the tier holds a significant coefficient
  uint32_t significant_count = 0;  ///< coefficients that are significant
};

/// Which coefficients of a band are in which tier. Those that do not exist are in none.
struct BandTiers {
  ZeroedArray<uint32_t> members;  ///< of each tier a bit map (BandShape::word), one behind another
  std::vector<uint8_t> blocks;    ///< tiers that a block has coefficients of: bit t for tier t
  std::vector<uint8_t> near;      ///< the same of a block and the eight around it

  uint64_t bytes() const { return members.size() * sizeof(uint32_t) + blocks.size() + near.size(); }
  /// What the tiers of a band of that shape take.
  static uint64_t bytesOf(const BandShape& shape);
  /// blocks and near, from the members.
  void markBlocks(const BandShape& shape);
};

struct Band {
  static constexpr uint32_t kBlockRows = 8;  ///< blocks are one word wide

  Band() = default;
  /// absent_cells: bit map of the coefficients that do not exist; empty: all do. band_tiers: null:
  /// all coefficients are in tier 0.
  Band(const BandShape& band_shape, Orientation band_orientation,
       std::span<const uint32_t> absent_cells = {},
       std::shared_ptr<const BandTiers> band_tiers = nullptr);

  /// Bytes that a band of that shape allocates, without its tiers, which its plan has as well.
  /// masked: some of its coefficients may be absent.
  static uint64_t bytesOf(const BandShape& band_shape, bool masked);

  uint32_t blockRows() const { return (shape.rows + kBlockRows - 1) / kBlockRows; }
  uint8_t& block(uint32_t y, uint32_t x) { return block_nonzero[size_t{y} * shape.words() + x]; }
  uint8_t tierBlocks(uint32_t y, uint32_t x) const {
    return tiers->blocks[size_t{y} * shape.words() + x];
  }

  /// The columns of a word that exist.
  uint32_t existing(uint32_t row, uint32_t index) const {
    const uint32_t valid = shape.valid(index);
    return absent.size() == 0 ? valid : valid & ~absent[shape.word(row, index)];
  }

  /// The columns of a word that are in a tier.
  uint32_t members(size_t tier, uint32_t row, uint32_t index) const {
    return tiers == nullptr ? existing(row, index)
                            : tiers->members[tier * shape.wordCells() + shape.word(row, index)];
  }

  /// A significant coefficient follows, in a band that may have had none so far.
  void makeCells();
  bool hasCells() const { return magnitude.size() > 0; }

  /// Nothing is known of the next bit-plane of a tier yet.
  void clearVisited(size_t tier = 0);

  bool nonzero() const {
    bool any = false;
    for (const TierState& tier : tier_states) any |= tier.nonzero;
    return any;
  }

  /// The columns of a word that have a significant neighbour. Significant ones themselves may or
  /// may not be among them.
  uint32_t nearSignificant(size_t word) const {
    const uint32_t stride = shape.wordStride();
    const uint32_t* s = significant.data() + word;
    const auto any = [&](ptrdiff_t i) { return s[i - stride] | s[i] | s[i + stride]; };
    const uint32_t here = any(0);
    return here | here << 1 | here >> 1 | any(-1) >> 31 | any(1) << 31;
  }

  /// The columns of a word that have a significant coefficient at most two, and at most three, rows
  /// and columns away.
  struct Reach {
    uint32_t two, three;
  };
  Reach significantWithin(size_t word) const {
    const auto stride = static_cast<ptrdiff_t>(shape.wordStride());
    const uint32_t* s = significant.data() + word;
    const auto two = [&](ptrdiff_t i) {
      return s[i - 2 * stride] | s[i - stride] | s[i] | s[i + stride] | s[i + 2 * stride];
    };
    const auto three = [&](ptrdiff_t i) { return s[i - 3 * stride] | s[i + 3 * stride]; };
    // 38 columns: those of the word from bit 3 on, and three on either side.
    const auto joined = [](uint32_t left, uint32_t here, uint32_t right) {
      return left >> 29 | uint64_t{here} << 3 | uint64_t{right & 7} << 35;
    };
    const auto spread = [](uint64_t bits) { return bits | bits << 1 | bits >> 1; };
    const uint64_t in_two = joined(two(-1), two(0), two(1));
    const uint64_t in_three = in_two | joined(three(-1), three(0), three(1));
    return {static_cast<uint32_t>(spread(spread(in_two)) >> 3),
            static_cast<uint32_t>(spread(spread(spread(in_three))) >> 3)};
  }

  BandShape shape;
  Orientation orientation = Orientation::kLL;
  std::array<TierState, kPriorities> tier_states;
  std::shared_ptr<const BandTiers> tiers;  ///< null: all coefficients are in tier 0
  // Of each cell, once makeCells() has been called: before that nothing is significant.
  ZeroedArray<uint32_t> magnitude;  ///< known bits, unknown ones zero
  ZeroedArray<uint8_t> scaled;      ///< magnitude >> plane, held below 2^7; of the last pass's tier
  ZeroedArray<int8_t> sign;         ///< -1, 0 while insignificant, 1
  // From the start.
  ZeroedArray<uint32_t> significant;  ///< bit map: magnitude is not zero
  /// Bit map: bit `plane` of its tier is known, or absent. All of a tier without a significant one.
  ZeroedArray<uint32_t> visited;
  ZeroedArray<uint32_t> absent;        ///< bit map: does not exist; without elements: all do
  ZeroedArray<uint8_t> block_nonzero;  ///< tiers of which the block holds a significant one
};

}  // namespace tetrakis::inline track
