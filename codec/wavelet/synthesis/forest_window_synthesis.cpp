// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/synthesis/forest_window_synthesis.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "bitstream/track/reconstruction.hpp"
#include "codec/wavelet/forest_lifting.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"

namespace tetrakis::inline synthesis {

namespace {

/// The samples along a side of a patch of a level.
uint32_t sideOf(const Forest& forest, int level) {
  return ((forest.side() - 1) >> level) + 1;
}

/// What a window of the raster of a level shows of each patch.
PatchWindows shownOf(const Forest& forest, int level, const Window& window) {
  const uint32_t side = sideOf(forest, level);
  PatchWindows shown(forest.patches());
  for (uint32_t patch = window.y / side; patch * side < window.y + window.height; ++patch) {
    const uint32_t top = std::max(window.y, patch * side),
                   bottom = std::min(window.y + window.height, (patch + 1) * side);
    shown[patch] = {window.x, top - patch * side, window.width, bottom - top};
  }
  return shown;
}

/// The part of a block that is low in both directions.
Window lowOf(const Window& block) {
  return {block.x / 2, block.y / 2, (block.width + 1) / 2, (block.height + 1) / 2};
}

/// What a band holds of the part of a block.
Window bandOf(const Window& block, const Subband& subband) {
  Window band = lowOf(block);
  if (subband.isHighX()) band.width = block.width / 2;
  if (subband.isHighY()) band.height = block.height / 2;
  return band;
}

uint64_t samplesOf(const PatchWindows& windows) {
  uint64_t samples = 0;
  for (const Window& window : windows) samples += window.extent().samples();
  return samples;
}

}  // namespace

ForestBlocks::ForestBlocks(const WaveletSpec& spec, const View& view)
    : level_(view.level),
      shown_(view.window->extent().samples()),
      patches_(spec.forest->patches()) {
  const Forest& forest = *spec.forest;
  PatchWindows wanted = shownOf(forest, level_, *view.window);
  for (int level = level_ + 1; sideOf(forest, level - 1) > kSmallestSide; ++level) {
    blocks_.push_back(reachOf(forest, sideOf(forest, level - 1) - 1, spec.filter(level), wanted));
    std::transform(blocks_.back().begin(), blocks_.back().end(), wanted.begin(), lowOf);
  }
}

uint64_t ForestBlocks::coefficients() const {
  constexpr uint64_t kLowest = (kSmallestSide - 1) * (kSmallestSide - 1);
  uint64_t sum = patches_ * kLowest;
  for (const PatchWindows& blocks : blocks_) sum += samplesOf(blocks);
  return sum;
}

/// The lifting of the largest level, and the samples that are shown; of each level a block and its
/// values for each patch.
uint64_t ForestBlocks::workBytes() const {
  uint64_t most = 0;
  for (const PatchWindows& blocks : blocks_) most = std::max(most, ForestLifting::bytesOf(blocks));
  const uint64_t once = patches_ * blocks_.size() * (sizeof(Window) + sizeof(std::vector<int32_t>));
  return most + once + shown_ * sizeof(int32_t);
}

ForestWindowSynthesis::ForestWindowSynthesis(const WaveletSpec& spec, const Pyramid& pyramid,
                                             const View& view)
    : spec_(spec),
      pyramid_(&pyramid),
      level_(view.level),
      window_(*view.window),
      blocks_(spec, view) {
  assert(blocks_.levels() == pyramid.levels());
  assert(window_.isInside(pyramid.low(level_).extent));
}

void ForestWindowSynthesis::allocate() {
  for (int level = level_ + 1; level <= pyramid_->levels(); ++level) {
    Values& values = values_.emplace_back();
    for (const Window& block : blocks_.at(level)) values.emplace_back(block.extent().samples());
  }
  ll_.resize(pyramid_->low(pyramid_->levels()).extent.samples());
}

/// The coarsest of its levels reaches farthest.
bool ForestWindowSynthesis::mayNeed(const Region& region) const {
  const int level = std::min(region.last_level, pyramid_->levels());
  if (region.isBase() || level < region.first_level) return true;
  if (level <= level_) return false;
  const uint32_t rows = spec_.forest->side(), patch = region.y0 / rows;
  const Window block = blocks_.at(level)[patch];
  const auto meets = [&](uint32_t begin, uint32_t size, uint32_t first, uint32_t end) {
    return uint64_t{begin} << (level - 1) < end && first < (uint64_t{begin} + size) << (level - 1);
  };
  return block.width > 0 && meets(block.x, block.width, region.x0, region.x1) &&
         meets(block.y, block.height, region.y0 - patch * rows, region.y1 - patch * rows);
}

Window ForestWindowSynthesis::needed(const Subband& subband) const {
  if (subband.orientation == Orientation::kLL) return {0, 0, subband.width, subband.height};
  if (subband.level <= level_) return {};
  return bandOf(blocks_.at(subband.level)[subband.patch], subband);
}

bool ForestWindowSynthesis::needs(const BandPart& part) const {
  const Window needed = this->needed(pyramid_->subbands()[part.subband]);
  return needed.meets({part.column, part.row, part.columns, part.rows});
}

std::span<int32_t> ForestWindowSynthesis::row(const Subband& subband, uint32_t row) {
  if (subband.orientation == Orientation::kLL)
    return std::span(ll_).subspan((size_t{subband.patch} * subband.height + row) * subband.width,
                                  subband.width);
  const Window& block = blocks_.at(subband.level)[subband.patch];
  const Window band = bandOf(block, subband);
  const size_t in_block = 2 * size_t{row} + subband.isHighY();
  const size_t before = subband.isHighX() ? lowOf(block).width : 0;
  return std::span(valuesAt(subband.level)[subband.patch])
      .subspan(in_block * block.width + before, band.width);
}

void ForestWindowSynthesis::put(const Band& band, int fraction_bits, const BandPart& part) {
  if (!needs(part) || !band.hasCells()) return;
  const Subband& subband = pyramid_->subbands()[part.subband];
  const Window wanted = needed(subband);
  const Reconstruction values(band, fraction_bits);
  std::vector<int32_t> line(part.columns);
  const uint32_t first = std::max(part.column, wanted.x),
                 last = std::min(part.column + part.columns, wanted.x + wanted.width);
  for (uint32_t y = std::max(part.row, wanted.y);
       y < std::min(part.row + part.rows, wanted.y + wanted.height); ++y) {
    values.row(y - part.row, line.data());
    std::copy(line.begin() + (first - part.column), line.begin() + (last - part.column),
              row(subband, y - wanted.y).begin() + (first - wanted.x));
  }
}

/// Puts the samples of the next coarser level, or LL, to their places among the coefficients.
void ForestWindowSynthesis::putLow(const Values& finished, int level) {
  for (size_t patch = 0; patch < finished.size() || patch < spec_.forest->patches(); ++patch) {
    const Window &block = blocks_.at(level)[patch], low = lowOf(block);
    const bool is_ll = finished.empty();
    const LowBand& coarsest = pyramid_->low(pyramid_->levels());
    const Window from = is_ll ? Window{0, 0, coarsest.extent.width, coarsest.patch_rows}
                              : blocks_.at(level + 1)[patch];
    const int32_t* const values =
        is_ll ? ll_.data() + patch * from.extent().samples() : finished[patch].data();
    for (uint32_t y = 0; y < low.height; ++y) {
      const size_t first = size_t{low.y + y - from.y} * from.width + (low.x - from.x);
      std::copy_n(values + first, low.width,
                  valuesAt(level)[patch].data() + 2 * size_t{y} * block.width);
    }
  }
}

std::vector<int32_t> ForestWindowSynthesis::shownOf(const Values& finished) const {
  const PatchWindows shown = synthesis::shownOf(*spec_.forest, level_, window_);
  std::vector<int32_t> samples;
  samples.reserve(window_.extent().samples());
  for (size_t patch = 0; patch < shown.size(); ++patch) {
    const Window &part = shown[patch], &block = blocks_.at(level_ + 1)[patch];
    for (uint32_t y = part.y; y < part.y + part.height; ++y) {
      const int32_t* const row =
          finished[patch].data() + size_t{y - block.y} * block.width + (part.x - block.x);
      samples.insert(samples.end(), row, row + part.width);
    }
  }
  return samples;
}

std::vector<int32_t> ForestWindowSynthesis::run(uint32_t) {
  std::optional<HeldCells> held;
  if (!pyramid_->held().none()) held.emplace(spec_, *pyramid_);
  Values finished;
  for (int level = pyramid_->levels(); level > level_; --level) {
    putLow(finished, level);
    ForestLifting(spec_, *pyramid_, level, blocks_.at(level))
        .run(valuesAt(level), held ? held->level(level) : HeldCellsOfLevel());
    finished = std::move(valuesAt(level));
  }
  std::vector<int32_t> samples;
  if (level_ < pyramid_->levels()) {
    samples = shownOf(finished);
  } else {
    const LowBand& low = pyramid_->low(level_);
    shareOwned(*spec_.forest, std::span(ll_), low.extent.width - 1);
    samples = slice(std::span<const int32_t>(ll_), low.extent, {0, window_});
  }
  takeOutGain(spec_, *pyramid_, level_, samples);
  return samples;
}

}  // namespace tetrakis::inline synthesis
