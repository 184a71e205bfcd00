// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/band.hpp"

#include <algorithm>

namespace tetrakis::inline track {

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

uint64_t Band::bytesOf(const BandShape& band_shape, bool masked) {
  const uint64_t cell = sizeof(uint32_t) + sizeof(uint8_t) + sizeof(int8_t);
  const uint64_t word = (masked ? 3 : 2) * sizeof(uint32_t);
  const uint64_t blocks =
      (uint64_t{band_shape.rows} + kBlockRows - 1) / kBlockRows * band_shape.words();
  return band_shape.cells() * cell + band_shape.wordCells() * word + blocks;
}

void Band::clearVisited() {
  if (absent.size() == 0) {
    std::fill(visited.begin(), visited.end(), 0);
  } else {
    std::copy(absent.begin(), absent.end(), visited.begin());
  }
}

}  // namespace tetrakis::inline track
