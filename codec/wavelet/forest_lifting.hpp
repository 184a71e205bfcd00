// SPDX-License-Identifier: Apache-2.0
// ForestLifting is one level of the transform of a forest: joint lifting (lifting/lifting.hpp) of
// all patches, of which each sees the samples around it that lines reach across its sides.
//
// Where sides are turned the rows of one patch are the columns of the next, so rows and columns are
// lifted together: a step changes samples at centres, at sides or at corners, and reads none of
// those that it changes. A sample that several patches share is changed in the one that owns it. A
// sample that is held changes as held_cells.hpp says.
//
// For a window it lifts a block of each patch alone. What a block sees of samples that lie in no
// block is not defined, and reachOf() leaves these around the samples that are wanted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/forest.hpp"
#include "codec/wavelet/forest_reach.hpp"
#include "codec/wavelet/held_cells.hpp"
#include "codec/wavelet/lifting/lifting.hpp"
#include "codec/wavelet/pyramid.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline wavelet {

class ForestLifting {
 public:
  /// The level that is lifted, and the one whose low band the values are; 0: the raster.
  struct Levels {
    int plane, lifted;
  };

  /// spec: with a forest, whose pyramid it is. threads: nothing depends on them.
  ForestLifting(const WaveletSpec& spec, const Pyramid& pyramid, Levels levels, Direction direction,
                uint32_t threads = 1);

  /// For the inverse of a block of each patch. blocks: of reachOf().
  ForestLifting(const WaveletSpec& spec, const Pyramid& pyramid, int level,
                const PatchWindows& blocks);

  /// Turns the samples of the level into coefficients, or back, in place. values: of the low band.
  /// held: what the level makes of the areas that are held; empty: nothing is held.
  void run(std::span<int32_t> values, const HeldCellsOfLevel& held = {});
  /// The same of blocks. values: of each block, its even columns before its odd ones; on return in
  /// their order.
  void run(std::vector<std::vector<int32_t>>& values, const HeldCellsOfLevel& held);

  /// The bytes that the largest level above one takes.
  static uint64_t bytesOf(const Forest& forest, int level);
  /// The bytes that blocks take.
  static uint64_t bytesOf(const PatchWindows& blocks);

 private:
  /// Values of the patches with their surroundings, by index.
  struct Copy {
    size_t to, from;
  };

  /// What is lifted of a patch, and where its values lie, with what lies around it.
  struct Block {
    Window at;  ///< begins at an even column and row
    size_t first = 0;
    uint32_t width = 0, height = 0;
  };

  /// Columns or rows from one on, all within a patch or all beyond one of its sides.
  struct Range {
    int64_t first;
    size_t count;
  };

  ForestLifting(const WaveletSpec& spec, const Pyramid& pyramid, Levels levels, Direction direction,
                uint32_t threads, const PatchWindows& blocks);
  bool isWhole(const Block& block) const { return block.at == Window{0, 0, n_ + 1, n_ + 1}; }
  bool holds(const Forest::Place& place) const;
  /// Of a sample of a block, or of what lies around it; even columns come before odd ones.
  size_t indexOf(uint32_t patch, int64_t x, int64_t y) const;
  size_t indexOf(const Forest::Place& place) const {
    return indexOf(place.patch, place.x, place.y);
  }
  void findCopies();
  void seeAround(uint32_t patch);
  void see(uint32_t patch, const Range& columns, const Range& rows);
  void copyAll(const std::vector<Copy>& copies);
  void lift(size_t round, const HeldCellsOfLevel& held);
  void step(size_t round, JointStep step, const HeldCellsOfLevel& held);
  void findNumbers();
  /// Gives held samples of a patch their values, of those that a step changes.
  void hold(uint32_t patch, JointStep step, const std::vector<HeldCell>& held);
  void holdAll(const std::vector<HeldCell>& held);
  /// Calls move(value at its place among those of rowOf(patch, y), value here) for all samples of
  /// the blocks. halved: even columns come first there.
  template <class RowOf, class Move>
  void forEachSample(const RowOf& rowOf, bool halved, const Move& move);
  template <class RowOf>
  void runRows(const RowOf& rowOf, const HeldCellsOfLevel& held);

  const Forest& forest_;
  const Pyramid& pyramid_;
  LowBand plane_;  ///< what the values are
  int level_;
  FilterId id_;
  Direction direction_;
  bool doubled_, wide_;
  uint32_t threads_;
  uint32_t n_, margin_;        ///< of a patch; around a block
  std::vector<Block> blocks_;  ///< of all patches
  std::vector<int32_t> values_;
  std::vector<uint16_t> numbers_;  ///< of held samples, laid out like the values; empty: none
  std::vector<Copy> around_, shared_;
  std::vector<size_t> column_parts_,
      row_parts_;  ///< of indices around a patch, while copies are found
};

}  // namespace tetrakis::inline wavelet
