// SPDX-License-Identifier: Apache-2.0
#include "doors/gdal/block_strips.hpp"

#include <algorithm>

namespace tetrakis::gdal {

tks_window BlockStrips::grown(const tks_window& blocks, const BlockGrid& grid) {
  const uint32_t rows = std::min(grid.strip_rows, grid.down);
  const bool next = strip_end_ != 0 && blocks.y == strip_end_;
  spent_ += std::min(uint64_t{blocks.width} + grid.columns_around, uint64_t{grid.across}) *
            std::min(uint64_t{blocks.height} + grid.rows_around, uint64_t{grid.down});
  const uint64_t price = uint64_t{grid.across} * std::min(rows + grid.rows_around, grid.down);
  if (blocks.height > rows || (!next && 2 * spent_ < price)) return blocks;
  spent_ = 0;
  const uint32_t top = std::min(blocks.y, grid.down - rows);
  strip_end_ = top + rows;
  return {0, top, grid.across, rows};
}

}  // namespace tetrakis::gdal
