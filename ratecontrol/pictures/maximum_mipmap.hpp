// SPDX-License-Identifier: Apache-2.0
// MaximumMipmap holds the highest ground of square blocks of cells, level by level: each block of a
// level covers two by two blocks of the level before. A ray that passes above a block meets none of
// its cells (A. Tevs, I. Ihrke, H.-P. Seidel 2008: maximum mipmaps for fast, accurate, and scalable
// dynamic height field rendering).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/plane.hpp"

namespace tetrakis::inline pictures {

class MaximumMipmap {
 public:
  /// heights: of a grid of at least one vertex, row by row; NaN is a void, which is below all. A
  /// cell lies between four vertices; a grid of one column or row has none.
  MaximumMipmap(const std::vector<float>& heights, Extent grid);

  /// How many cells there are.
  Extent cells() const { return {levels_[0].width, levels_[0].height}; }
  /// The level whose only block covers all cells; blocks of level k are 2^k cells a side.
  size_t top() const { return levels_.size() - 1; }
  /// The highest vertex of the block of that level around a cell.
  float above(uint32_t column, uint32_t row, size_t level) const {
    const Level& of = levels_[level];
    return of.highest[size_t{row >> level} * of.width + (column >> level)];
  }

 private:
  struct Level {
    uint32_t width = 0, height = 0;  ///< in blocks
    std::vector<float> highest;
  };
  static Level cellsOf(const std::vector<float>& heights, Extent grid);
  static Level halved(const Level& fine);

  std::vector<Level> levels_;  ///< from single cells up
};

}  // namespace tetrakis::inline pictures
