// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/block_cache.hpp"

#include <algorithm>
#include <vector>

#include "apps/doors/gdal/dataset.hpp"
#include "apps/doors/gdal/pixels.hpp"

namespace tetrakis::gdal {

/// Pixels that were decoded, channels interleaved.
struct DecodedWindow {
  tks_window window;
  std::vector<std::byte> pixels;
};

namespace {

constexpr int kBlock = 256;       ///< side of blocks where there are no regions
constexpr int kWindowBlock = 64;  ///< where there are
/// Seven times the reach of the widest filters at level 1 is as far as the coefficients of the
/// finest regions get, those of levels 1 to 3 (docs/FORMAT.md, sections 7 and 10: 126 samples).
constexpr uint32_t kReach = 128;

bool isCached(GDALRasterBand& band, uint32_t x, uint32_t y) {
  GDALRasterBlock* const block =
      band.TryGetLockedBlockRef(static_cast<int>(x), static_cast<int>(y));
  if (block != nullptr) block->DropLock();
  return block != nullptr;
}

bool areCached(GDALRasterBand& band, const tks_window& blocks) {
  for (uint32_t y = blocks.y; y < blocks.y + blocks.height; ++y)
    for (uint32_t x = blocks.x; x < blocks.x + blocks.width; ++x)
      if (!isCached(band, x, y)) return false;
  return true;
}

/// Without rows and columns at the border that are there, but for `missing`: GDAL puts a block into
/// its cache before it asks for its samples.
tks_window trimmed(GDALRasterBand& band, tks_window blocks, const tks_window& missing) {
  const auto& [x, y, width, height] = blocks;
  const auto right = [&] { return x + width - 1; };
  const auto bottom = [&] { return y + height - 1; };
  while (y < missing.y && areCached(band, {x, y, width, 1})) ++blocks.y, --blocks.height;
  while (bottom() >= missing.y + missing.height && areCached(band, {x, bottom(), width, 1}))
    --blocks.height;
  while (x < missing.x && areCached(band, {x, y, 1, height})) ++blocks.x, --blocks.width;
  while (right() >= missing.x + missing.width && areCached(band, {right(), y, 1, height}))
    --blocks.width;
  return blocks;
}

/// What is missing in a row of blocks, from the first one to the last; of width 0: nothing.
tks_window missingIn(GDALRasterBand& band, const tks_window& row) {
  uint32_t begin = row.x, end = row.x + row.width;
  while (begin < end && isCached(band, begin, row.y)) ++begin;
  while (begin < end && isCached(band, end - 1, row.y)) --end;
  return {begin, row.y, end - begin, 1};
}

}  // namespace

int blockSide(const Source& source) {
  return source.regionSide() == 0 ? kBlock : kWindowBlock;
}

uint64_t BlockCache::blocksAtOnce() const {
  int width = 0, height = 0;
  dataset_.GetRasterBand(1)->GetBlockSize(&width, &height);
  const uint64_t bytes = uint64_t(width) * uint64_t(height) * dataset_.source().pixelBytes();
  return std::max<uint64_t>(static_cast<uint64_t>(GDALGetCacheMax64()) / 4 / bytes, 1);
}

BlockGrid BlockCache::grid() const {
  int width = 0, height = 0;
  dataset_.GetRasterBand(1)->GetBlockSize(&width, &height);
  const uint32_t level = dataset_.level();
  const uint32_t region = std::max(dataset_.source().regionSide() >> level, 1U);
  const uint32_t reach = (kReach >> level) + level;  // overviews: means of three samples
  const auto axis = [&](int samples, int block) {
    return BlockAxis{static_cast<uint32_t>(samples), static_cast<uint32_t>(block), region, reach};
  };
  return {axis(dataset_.GetRasterXSize(), width), axis(dataset_.GetRasterYSize(), height),
          blocksAtOnce()};
}

uint32_t BlockCache::rowsAtOnce(uint32_t width, uint32_t top) const {
  const BlockGrid blocks = grid();
  const uint64_t across = width / blocks.across.block + 2;
  const uint64_t rows = std::clamp<uint64_t>(blocks.most / across, 1, blocks.down.blocks());
  return static_cast<uint32_t>(rows * blocks.down.block - top % blocks.down.block);
}

tks_window BlockCache::withNeighbours(GDALRasterBand& band, const tks_window& blocks) {
  return dataset_.readsWindows() ? trimmed(band, growth_.grown(blocks, grid()), blocks) : blocks;
}

bool BlockCache::fill(GDALRasterBand& band, const tks_window& samples) {
  const BlockGrid blocks = grid();
  const uint32_t left = samples.x / blocks.across.block;
  const uint32_t width = (samples.x + samples.width - 1) / blocks.across.block + 1 - left;
  const uint32_t bottom = (samples.y + samples.height - 1) / blocks.down.block + 1;
  for (uint32_t y = samples.y / blocks.down.block; y < bottom;) {
    tks_window missing = missingIn(band, {left, y, width, 1});
    // Rows that lack the same are decoded together: a window that moves lacks a row and a column.
    for (++y; missing.width > 0 && y < bottom; ++y, ++missing.height) {
      const tks_window next = missingIn(band, {left, y, width, 1});
      if (next.x != missing.x || next.width != missing.width) break;
    }
    if (missing.width > 0 && !decode(withNeighbours(band, missing), nullptr)) return false;
  }
  return true;
}

bool BlockCache::read(GDALRasterBand& band, uint32_t x, uint32_t y, std::byte* out) {
  const Block wanted{band.GetBand(), x, y, out};
  return decode(withNeighbours(band, {x, y, 1, 1}), &wanted);
}

bool BlockCache::decode(const tks_window& blocks, const Block* wanted) {
  const BlockGrid all = grid();
  const uint32_t x = blocks.x * all.across.block, y = blocks.y * all.down.block;
  DecodedWindow decoded{{x, y, std::min(blocks.width * all.across.block, all.across.samples - x),
                         std::min(blocks.height * all.down.block, all.down.samples - y)},
                        {}};
  if (!dataset_.read(decoded.window, decoded.pixels)) return false;
  for (int band = 1; band <= dataset_.GetRasterCount(); ++band)
    if (!take(decoded, blocks, band, wanted)) return false;
  return true;
}

bool BlockCache::take(const DecodedWindow& decoded, const tks_window& blocks, int band,
                      const Block* wanted) {
  GDALRasterBand& of = *dataset_.GetRasterBand(band);
  for (uint32_t y = blocks.y; y < blocks.y + blocks.height; ++y) {
    for (uint32_t x = blocks.x; x < blocks.x + blocks.width; ++x) {
      if (wanted != nullptr && band == wanted->band && x == wanted->x && y == wanted->y) {
        spread(decoded, *wanted);
        continue;
      }
      if (isCached(of, x, y)) continue;
      GDALRasterBlock* const block =
          of.GetLockedBlockRef(static_cast<int>(x), static_cast<int>(y), TRUE);
      if (block == nullptr) return false;
      spread(decoded, {band, x, y, static_cast<std::byte*>(block->GetDataRef())});
      block->DropLock();
    }
  }
  return true;
}

void BlockCache::spread(const DecodedWindow& decoded, const Block& block) const {
  int width = 0, height = 0;
  dataset_.GetRasterBand(block.band)->GetBlockSize(&width, &height);
  const tks_window& window = decoded.window;
  const size_t sample = tks_sample_bytes(dataset_.source().sample());
  const size_t pixel = dataset_.source().pixelBytes(), row = window.width * pixel;
  const uint32_t x = block.x * static_cast<uint32_t>(width) - window.x;
  const uint32_t y = block.y * static_cast<uint32_t>(height) - window.y;
  const Pixels from{decoded.pixels.data() + y * row + x * pixel + (block.band - 1) * sample, row,
                    pixel, std::min(static_cast<uint32_t>(width), window.width - x),
                    std::min(static_cast<uint32_t>(height), window.height - y)};
  copySamples(from, sample, block.out, static_cast<size_t>(width) * sample);
}

}  // namespace tetrakis::gdal
