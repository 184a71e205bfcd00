// SPDX-License-Identifier: Apache-2.0
// What to decode where blocks of a raster are asked for. Who reads one after the other decodes the
// regions around them again and again: once that has cost half of what a strip of all columns
// costs, the strip is decoded, and so is the next one below it. It is all of the raster where a
// strip may be so high, which then has cost one and a half times what it must. (Renting skis, and
// then buying them.)
#pragma once

#include <cstdint>

#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

/// A raster in blocks, and what is decoded of it.
struct BlockGrid {
  uint32_t across, down;    ///< blocks
  uint32_t strip_rows;      ///< rows of blocks in a strip
  uint32_t columns_around;  ///< of blocks that are decoded with any
  uint32_t rows_around;
};

class BlockStrips {
 public:
  /// These blocks, or a strip that holds them.
  tks_window grown(const tks_window& blocks, const BlockGrid& grid);

 private:
  uint64_t spent_ = 0;      ///< blocks that were decoded since the last strip
  uint32_t strip_end_ = 0;  ///< the row of blocks below that strip
};

}  // namespace tetrakis::gdal
