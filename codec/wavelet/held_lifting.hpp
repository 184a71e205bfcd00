// SPDX-License-Identifier: Apache-2.0
// liftHeldColumns() and HeldRowLifting lift planes in which some samples are held: encoder and
// decoder know their values before any coefficient. A step reads a held sample but does not change
// it as it changes others: the held sample gets the value that the step gives to a signal of that
// value everywhere. So constants are predicted exactly up to the shore of a lake, no coefficient of
// a held sample is coded, and nothing rings across the shore: land next to water is predicted from
// the water's true height, and an update finds no detail on the water.
//
// In a signal of one value all even samples stay equal in every step, and so do all odd ones. With
// s[0] = s[1] = the value, step i of an analysis changes the samples s[i] into s[i + 2] and reads
// the samples s[i + 1]. With filters whose predictions sum to -1 the odd samples become 0, and the
// even ones keep the value.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/wavelet/pyramid.hpp"

#include "codec/wavelet/lifting/lifting.hpp"
#include "codec/wavelet/lifting/lifting_steps.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline wavelet {

/// [i][area]: s[i] of the area, as the opening comment names it.
using HeldStates = std::vector<std::vector<int32_t>>;

/// What one level makes of the values of all areas.
struct HeldLevel {
  HeldStates rows;                       ///< empty: the level does not split rows
  HeldStates low_columns, high_columns;  ///< of low and of high samples of rows; empty: likewise

  /// The values that held samples of a quarter of the level have after the analysis.
  std::span<const int32_t> after(bool high_x, bool high_y) const;
  /// The states of the columns of one half of the rows.
  const HeldStates& columns(bool high_x) const { return high_x ? high_columns : low_columns; }
};

/// What the levels of a transform make of the values of all areas.
class HeldLadder {
 public:
  /// The pyramid outlives this.
  HeldLadder(const WaveletSpec& spec, const Pyramid& pyramid);

  /// level: from 1 on.
  HeldLevel level(int level) const;

 private:
  WaveletSpec spec_;
  const Pyramid* pyramid_;
  std::vector<std::vector<int32_t>> values_;  ///< [level]: of its low band, doubled where it is
};

/// The held samples of some samples at equal distances.
struct HeldLine {
  const uint16_t* first = nullptr;
  size_t pitch = 0;  ///< from one number to the next

  HeldLine from(size_t begin) const { return {first + begin * pitch, pitch}; }
};

/// Where the held samples of a block lie: a block of the low band that a level splits, whose rows
/// have their even samples before their odd ones if they are split.
class HeldBlock {
 public:
  /// level: the one that splits the block, of a pyramid with held samples.
  HeldBlock(const Pyramid& pyramid, const HeldLevel& states, int level, const Window& block);

  const HeldLevel& states() const { return *states_; }
  /// The low or the high samples of a row; rows that are not split have low ones alone.
  HeldLine line(ptrdiff_t row, bool high_x) const;
  bool splitsRows() const { return half_ > 0; }

 private:
  const HeldLevel* states_;
  const uint16_t* first_;
  size_t row_, column_;  ///< distances of rows, and of the samples of a half
  size_t half_;          ///< of an odd sample from the even one before; 0: rows are not split
};

/// Gives held samples their values; others keep theirs.
void hold(const HeldLine& line, std::span<const int32_t> values, std::span<int32_t> samples);

/// Signals of one filter.
struct LiftedSignals {
  FilterId id;
  Direction direction;
  bool wide;
};

/// Columns [begin, begin + rows.width) of a block, as they lie in it.
struct HeldColumns {
  const HeldBlock* block;
  uint32_t begin, lows;  ///< lows: columns of the block that are low
};

/// Does what liftColumns() does, or liftMaskedColumns() where there is a mask, beside held samples.
void liftHeldColumns(const Rows<int32_t>& rows, const Rows<const uint8_t>* valid,
                     const HeldColumns& columns, const LiftedSignals& signals);

/// Does what RowLifting and MaskedRowLifting do, beside held samples.
class HeldRowLifting {
 public:
  HeldRowLifting(uint32_t longest, Ends ends) : values_(longest, ends), valid_(longest, ends) {}

  /// valid: of the row, the low half before the high half; null: all samples exist.
  void lift(std::span<int32_t> row, const uint8_t* valid, const HeldBlock& block, ptrdiff_t number,
            const LiftedSignals& signals);

 private:
  Halves<int32_t> values_;
  Halves<uint8_t> valid_;
  MaskedStep step_;
};

}  // namespace tetrakis::inline wavelet
