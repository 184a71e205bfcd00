// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/band.hpp"

#include <algorithm>
#include <utility>

namespace tetrakis::inline track {

uint64_t BandTiers::bytesOf(const BandShape& shape) {
  const uint64_t rows = (uint64_t{shape.rows} + Band::kBlockRows - 1) / Band::kBlockRows;
  return kPriorities * shape.wordCells() * sizeof(uint32_t) + 2 * rows * shape.words();
}

void BandTiers::markBlocks(const BandShape& shape) {
  const uint32_t rows = (shape.rows + Band::kBlockRows - 1) / Band::kBlockRows;
  const uint32_t columns = shape.words();
  blocks.assign(size_t{rows} * columns, 0);
  for (size_t tier = 0; tier < kPriorities; ++tier) {
    for (uint32_t row = 0; row < shape.rows; ++row) {
      for (uint32_t x = 0; x < columns; ++x) {
        const bool any = members[tier * shape.wordCells() + shape.word(row, x)] != 0;
        uint8_t& block = blocks[size_t{row / Band::kBlockRows} * columns + x];
        block = static_cast<uint8_t>(block | (any ? 1u << tier : 0));
      }
    }
  }
  near = blocks;
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < columns; ++x) {
      uint8_t& all = near[size_t{y} * columns + x];
      for (uint32_t v = y > 0 ? y - 1 : 0; v < std::min(y + 2, rows); ++v)
        for (uint32_t u = x > 0 ? x - 1 : 0; u < std::min(x + 2, columns); ++u)
          all = static_cast<uint8_t>(all | blocks[size_t{v} * columns + u]);
    }
  }
}

Band::Band(const BandShape& band_shape, Orientation band_orientation,
           std::span<const uint32_t> absent_cells, std::shared_ptr<const BandTiers> band_tiers)
    : shape(band_shape),
      orientation(band_orientation),
      tiers(std::move(band_tiers)),
      significant(shape.wordCells()),
      visited(shape.wordCells()),
      block_nonzero(size_t{blockRows()} * shape.words()) {
  if (!absent_cells.empty()) {
    absent = ZeroedArray<uint32_t>(shape.wordCells());
    std::copy(absent_cells.begin(), absent_cells.end(), absent.begin());
  }
  if (tiers != nullptr) {
    std::fill(visited.begin(), visited.end(), ~uint32_t{0});
  } else if (absent.size() > 0) {
    clearVisited();
  }
}

uint64_t Band::bytesOf(const BandShape& band_shape, bool masked) {
  const uint64_t cell = sizeof(uint32_t) + sizeof(uint8_t) + sizeof(int8_t);
  const uint64_t word = (masked ? 3 : 2) * sizeof(uint32_t);
  const uint64_t blocks =
      (uint64_t{band_shape.rows} + kBlockRows - 1) / kBlockRows * band_shape.words();
  return band_shape.cells() * cell + band_shape.wordCells() * word + blocks;
}

void Band::makeCells() {
  if (hasCells()) return;
  magnitude = ZeroedArray<uint32_t>(shape.cells());
  scaled = ZeroedArray<uint8_t>(shape.cells());
  sign = ZeroedArray<int8_t>(shape.cells());
}

void Band::clearVisited(size_t tier) {
  if (tiers != nullptr) {
    const uint32_t* members = tiers->members.data() + tier * shape.wordCells();
    for (size_t i = 0; i < shape.wordCells(); ++i) visited[i] &= ~members[i];
  } else if (absent.size() == 0) {
    std::fill(visited.begin(), visited.end(), 0);
  } else {
    std::copy(absent.begin(), absent.end(), visited.begin());
  }
}

}  // namespace tetrakis::inline track
