// SPDX-License-Identifier: Apache-2.0
// LevelTransform is one level of the transform: it splits the rows and columns of a block, jointly
// or rows first, and the synthesis joins them in the opposite order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "codec/wavelet/lifting/lifting.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline wavelet {

class HeldBlock;

/// What a level splits: rows at equal distances, whose values lie side by side. Of coefficients the
/// low half of a row comes first, and low rows are those at even places.
struct SplitBlock {
  int32_t* first;
  size_t pitch;  ///< from one row to the next, in values
  Extent extent;
  Extent low;  ///< of the low part
  /// Pyramid::splitMask() of the block: a byte for each value; empty: all exist.
  std::span<const uint8_t> existing = {};
  const HeldBlock* held = nullptr;  ///< null: all samples are free

  std::span<int32_t> row(uint32_t y) const { return {first + y * pitch, extent.width}; }
  bool splitsRows() const { return low.width < extent.width; }
  bool splitsColumns() const { return low.height < extent.height; }
};

/// The bytes that lifting takes for each value of a row or a column, on each thread: both halves of
/// it and their masks.
inline constexpr uint64_t kLiftingBytes = 8;

class LevelTransform {
 public:
  /// threads: nothing depends on them.
  LevelTransform(const WaveletSpec& spec, int level, Direction direction, uint32_t threads = 1);

  /// Turns samples into coefficients, or back, in place.
  void run(const SplitBlock& block) const;

 private:
  bool analyses() const { return direction_ == Direction::kAnalysis; }

  void liftJointly(const SplitBlock& block) const;
  void liftRows(const SplitBlock& block) const;
  void liftColumns(const SplitBlock& block) const;
  /// The same beside held samples.
  void liftHeldRows(const SplitBlock& block) const;
  void liftHeldColumns(const SplitBlock& block) const;
  /// Where held samples lie is what the analysis leaves there, which is not coded.
  void holdCoefficients(const SplitBlock& block) const;

  /// Calls lift(begin, end) for parts of so many rows or columns, on several threads.
  void inChunks(uint32_t count, const std::function<void(uint32_t, uint32_t)>& lift) const;

  FilterId id_;
  Direction direction_;
  Ends ends_;  ///< of rows
  bool doubles_, wide_, joint_, jointly_wide_;
  uint32_t threads_;
};

}  // namespace tetrakis::inline wavelet
