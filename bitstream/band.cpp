// SPDX-License-Identifier: Apache-2.0
#include "bitstream/band.hpp"

#include <algorithm>

namespace tetrakis {

Band::Band(const BandShape& band_shape, Orientation band_orientation,
           std::span<const uint32_t> absent_cells)
    : shape(band_shape),
      orientation(band_orientation),
      magnitude(shape.cells()),
      scaled(shape.cells()),
      sign(shape.cells()),
      significant(shape.wordCells()),
      visited(shape.wordCells()),
      block_nonzero(size_t{blockRows()} * shape.words()) {
  if (absent_cells.empty()) return;
  absent = ZeroedArray<uint32_t>(shape.wordCells());
  std::copy(absent_cells.begin(), absent_cells.end(), absent.begin());
  clearVisited();
}

void Band::clearVisited() {
  if (absent.size() == 0) {
    std::fill(visited.begin(), visited.end(), 0);
  } else {
    std::copy(absent.begin(), absent.end(), visited.begin());
  }
}

}  // namespace tetrakis
