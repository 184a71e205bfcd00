// SPDX-License-Identifier: Apache-2.0
// Which blocks of a raster are decoded together where some are asked for. Regions are decoded
// whole, and with them their neighbours, whose coefficients reach into the blocks. Who goes on to
// the right or below gets what these regions show without any further one, which costs little more:
// so a window that moves on pays for new ground. A point or a window elsewhere gets itself alone:
// the decoder keeps its regions, and more samples would need more of their neighbours. Only who
// reads rows of blocks one after the other gets rows ahead, as many as it has read, so that strips
// grow as the reads of a file system do.
#pragma once

#include <cstdint>

#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

/// One axis of a raster, in samples.
struct BlockAxis {
  uint32_t samples, block;  ///< length, and that of a block
  uint32_t region;          ///< the side of regions
  uint32_t reach;           ///< how far coefficients of one region reach into others

  uint32_t blocks() const { return (samples + block - 1) / block; }
};

struct BlockGrid {
  BlockAxis across, down;
  uint64_t most;  ///< blocks to decode at once
};

class BlockGrowth {
 public:
  /// These blocks, and those that are decoded with them.
  tks_window grown(const tks_window& asked, const BlockGrid& grid);

 private:
  /// Whether the blocks begin the next row below rows that were read from left to right.
  bool goesDown(const tks_window& asked, const BlockGrid& grid) const;
  bool goesRight(const tks_window& asked) const;

  tks_window read_{};    ///< what was read one after the other, and is decoded
  uint32_t begin_ = 0;   ///< the column that rows begin in
  uint32_t in_row_ = 0;  ///< how many times blocks were asked for in the first rows
};

}  // namespace tetrakis::gdal
