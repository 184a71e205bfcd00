// SPDX-License-Identifier: Apache-2.0
// The bands that a dyadic wavelet leaves in the plane. Level 1 splits the plane, level l + 1 splits
// the low band of level l. Rows stay in place (the low band of level l has every 2^l-th row), which
// spares columns all copying; within a row the low half lies before the high half.
//
//   HL: high along the rows (x), low along the columns (y);  LH: the other way;  HH: high in both
//
// Of a height field, every coefficient belongs to one vertex of the 4-8 lattice: HH to the centres
// of its squares, HL and LH to the midpoints of their sides.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/track/band.hpp"

namespace tetrakis {

/// Sides of so many samples or fewer are not split; then HL or LH, and HH, are empty.
inline constexpr uint32_t kSmallestSide = 4;
inline constexpr size_t kBandsPerLevel = 3;
inline constexpr int kMaxLevels = 19;  ///< enough for sides up to 2^21

struct Extent {
  uint32_t width, height;
};

/// Sizes of the low bands: [0] the plane, [l] after level l.
std::vector<Extent> lowExtents(uint32_t width, uint32_t height);

/// One band of coefficients in the plane.
struct Subband {
  int level = 0;  ///< kLL: the number of levels
  Orientation orientation = Orientation::kLL;
  uint32_t width = 0, height = 0;
  uint32_t x = 0, y = 0;           ///< column and row of the first coefficient
  int splits_x = 0, splits_y = 0;  ///< how often each direction was split down to here

  /// Row of the plane that a row of the band lies in.
  uint32_t planeRow(uint32_t row) const { return y + (row << splits_y); }
  /// Column of the sample that a column of the band belongs to.
  uint32_t sampleColumn(uint32_t column) const {
    const bool high = orientation == Orientation::kHL || orientation == Orientation::kHH;
    return (column << splits_x) + (high ? uint32_t{1} << (splits_x - 1) : 0);
  }
};

/// LL, then HL, LH and HH of the coarsest level, and so on to level 1: 3 * levels + 1 bands, some
/// of them empty. Together they fill the plane.
std::vector<Subband> subbandsOf(uint32_t width, uint32_t height);

}  // namespace tetrakis
