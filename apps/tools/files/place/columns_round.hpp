// SPDX-License-Identifier: Apache-2.0
// columnsRound() tells whether the columns of a raster go round the Earth, so that the last one
// lies beside the first one.
#pragma once

#include <cstdint>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

enum class ColumnsRound {
  kNo,
  kOnce,      ///< through 360 degrees
  kRepeating  ///< through 360 degrees and one column more, which is the first one again
};

/// By the transform and the unit of a geographic CRS. What is not placed, or on a map, does not go
/// round, nor does what leaves a gap or overlaps by other than a column.
ColumnsRound columnsRound(const Georeference& place, uint32_t width);

}  // namespace tetrakis::tools
