// SPDX-License-Identifier: Apache-2.0
// columnsRound() tells whether the columns of a geographic grid go round the Earth, so that the
// last column lies beside the first one.
#pragma once

#include <cmath>
#include <cstdint>

namespace tetrakis::inline base {

enum class ColumnsRound : uint8_t {
  kNo,
  kOnce,      ///< through 360 degrees
  kRepeating  ///< through 360 degrees and one column more, which is the first one again
};

/// geotransform: six numbers in the order of GDAL. degrees: in the unit of its x and y; 0 where x
/// and y are no angles. Grids that leave a gap, or overlap by other than a column, do not go round.
inline ColumnsRound columnsRound(const double* geotransform, double degrees, uint32_t width) {
  /// Of a column: files write the width of one with some seven digits or more. A larger number
  /// glues sides with a gap in between.
  constexpr double kTolerance = 0.01;
  const double column = geotransform[1] * degrees;
  if (column == 0 || geotransform[2] != 0 || geotransform[4] != 0) return ColumnsRound::kNo;
  const double more = width - std::abs(360 / column);
  if (std::abs(more) < kTolerance) return ColumnsRound::kOnce;
  return std::abs(more - 1) < kTolerance ? ColumnsRound::kRepeating : ColumnsRound::kNo;
}

}  // namespace tetrakis::inline base
