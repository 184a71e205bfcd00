// SPDX-License-Identifier: Apache-2.0
// Lifting where some samples do not exist (after S. Li and W. Li, "Shape-adaptive discrete wavelet
// transforms", IEEE TCSVT 10(5), 2000). A void is neither read nor changed, so nothing bleeds
// across a coast:
//
//   a neighbour that is void stands for its mirror image about the target,
//   a pair of which both are void stands for the pair before it, leading ones for the first pair
//   that is not; a target without any stays as it is.
//
// Constants are predicted exactly as long as one pair is left.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wavelet/lifting.hpp"

namespace tetrakis {

/// Samples of a plane, width * height: 1 valid, 0 void; empty: all are valid.
using Validity = std::span<const uint8_t>;

/// Lifts one level of a plane with voids. Rows and columns without voids take the fast way.
class MaskedLifting {
 public:
  /// The low band that the level starts from has the samples (x << splits_x, y << splits_y) of the
  /// plane whose validity is given; plane_width: of that plane.
  MaskedLifting(Validity valid, uint32_t plane_width, const RowSet& rows, int splits_x,
                int splits_y);

  /// As RowLifting for all rows.
  void liftRows(RowLifting& fast, FilterId id, Direction direction, bool wide);
  /// As liftColumns. split_rows: the rows have been split before, or will be merged afterwards.
  void liftColumns(FilterId id, Direction direction, bool wide, bool split_rows);

 private:
  bool valid(uint32_t x, uint32_t y) const;
  uint32_t sampleColumn(uint32_t x, bool split_rows) const;
  bool columnIsWhole(uint32_t x, bool split_rows) const;
  void liftLine(FilterId id, Direction direction);

  Validity valid_;
  uint32_t plane_width_;
  RowSet rows_;
  int splits_x_, splits_y_;
  std::vector<int32_t> line_;
  std::vector<uint8_t> line_valid_;
};

}  // namespace tetrakis
