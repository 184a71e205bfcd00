// SPDX-License-Identifier: Apache-2.0
// The pixels of a dataset in GDAL's cache of blocks: what is decoded where some are missing.
#pragma once

#include <cstddef>
#include <cstdint>

#include "apps/doors/gdal/block_growth.hpp"
#include "tetrakis/tetrakis.h"

class GDALRasterBand;

namespace tetrakis::gdal {

class Dataset;
class Source;
struct DecodedWindow;

/// The side of blocks. A window is decoded from the first block that it meets to the last one:
/// where windows can be decoded, small blocks decode little around it.
int blockSide(const Source& source);

class BlockCache {
 public:
  explicit BlockCache(Dataset& dataset) : dataset_(dataset) {}

  /// Decodes what is missing of a band beneath a rectangle of samples, and of the other bands with
  /// it. Decoding one large window takes less than its blocks one by one.
  bool fill(GDALRasterBand& band, const tks_window& samples);
  /// One block of a band; others that are decoded with it go into the cache.
  bool read(GDALRasterBand& band, uint32_t x, uint32_t y, std::byte* out);
  /// How many rows of samples of this width to fill() at once: whole rows of blocks that a quarter
  /// of the cache holds, from `top` on.
  uint32_t rowsAtOnce(uint32_t width, uint32_t top) const;

 private:
  struct Block {
    int band;  ///< from 1 on
    uint32_t x, y;
    std::byte* out;
  };

  BlockGrid grid() const;
  uint64_t blocksAtOnce() const;
  tks_window withNeighbours(GDALRasterBand& band, const tks_window& blocks);
  /// Decodes blocks. That one, if there is one, goes where it is wanted, all others into the cache.
  bool decode(const tks_window& blocks, const Block* wanted);
  bool take(const DecodedWindow& decoded, const tks_window& blocks, int band, const Block* wanted);
  /// One block of one channel out of the pixels of a window.
  void spread(const DecodedWindow& decoded, const Block& block) const;

  Dataset& dataset_;
  BlockGrowth growth_;
};

}  // namespace tetrakis::gdal
