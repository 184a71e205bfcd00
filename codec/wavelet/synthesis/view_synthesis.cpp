// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/synthesis/view_synthesis.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "bitstream/track/reconstruction.hpp"
#include "codec/wavelet/held_lifting.hpp"

namespace tetrakis::inline synthesis {

/// A sample needs the places within the filter's reach; what the block's own ends do to the filter
/// stays outside of `needed`. Where the block ends with the plane both are mirrored alike.
WindowSynthesis::Axis WindowSynthesis::axisOf(Range needed, bool splits, uint32_t size,
                                              uint32_t reach) {
  assert(needed.begin < needed.end && needed.end <= size);
  if (!splits) return {needed, needed, {0, 0}};
  const uint32_t begin = (needed.begin - std::min(needed.begin, reach)) & ~uint32_t{1};
  const uint32_t end = needed.end + std::min(size - needed.end, reach);
  return {{begin, end}, {begin / 2, (end + 1) / 2}, {begin / 2, end / 2}};
}

/// Across the seam of a ring lies its other end, and in between a place without a sample if their
/// number is odd: rows that reach there are taken whole.
WindowSynthesis::Axis WindowSynthesis::rowAxisOf(Range needed, int level) const {
  const uint32_t size = pyramid_->low(level - 1).extent.width;
  const uint32_t reach = synthesisReach(spec_.filter(level));
  const bool at_seam = needed.begin < reach || size - needed.end < reach;
  if (spec_.ring && at_seam) needed = {0, size};
  return axisOf(needed, pyramid_->splitsX(level), size, reach);
}

ShownLow::ShownLow(const Pyramid& pyramid, const View& view) {
  const LowBand& low = pyramid.low(view.level);
  window = view.window.value_or(Window{0, 0, low.extent.width, low.extent.height});
  if (!view.window) return;
  const int finer_x = view.level - low.splits_x, finer_y = view.level - low.splits_y;
  step_x <<= finer_x;
  step_y <<= finer_y;
  window = {window.x << finer_x, window.y << finer_y, (window.width - 1) * step_x + 1,
            (window.height - 1) * step_y + 1};
}

WindowSynthesis::WindowSynthesis(const WaveletSpec& spec, const Pyramid& pyramid, const View& view)
    : spec_(spec),
      pyramid_(&pyramid),
      level_(view.level),
      shown_(pyramid, view),
      ll_x_{shown_.window.x, shown_.window.x + shown_.window.width},
      ll_y_{shown_.window.y, shown_.window.y + shown_.window.height} {
  assert(shown_.window.isInside(pyramid.low(level_).extent));
  for (int level = level_ + 1; level <= pyramid.levels(); ++level) {
    const uint32_t height = pyramid.low(level - 1).extent.height;
    const uint32_t reach = synthesisReach(spec_.filter(level));
    Level block{rowAxisOf(ll_x_, level), axisOf(ll_y_, pyramid.splitsY(level), height, reach), {}};
    ll_x_ = block.x.low;
    ll_y_ = block.y.low;
    levels_.push_back(std::move(block));
  }
}

void WindowSynthesis::allocate() {
  for (Level& level : levels_) level.values.resize(level.samples());
  ll_.resize(size_t{ll_x_.size()} * ll_y_.size());
}

uint64_t WindowSynthesis::coefficients() const {
  uint64_t sum = uint64_t{ll_x_.size()} * ll_y_.size();
  for (const Level& level : levels_) sum += level.samples();
  return sum;
}

/// The largest part that run() takes out of a block for the next level, or for the window; the mask
/// of the largest block; of each row or column that is lifted, its halves and their masks.
uint64_t WindowSynthesis::workBytes(uint32_t, bool masked) const {
  constexpr uint64_t kAround = 1024;  // what a filter reaches beyond a row, and more
  uint64_t largest_block = 0, largest_part = shown_.window.extent().samples(),
           widest = shown_.window.width;
  for (const Level& level : levels_) {
    largest_block = std::max<uint64_t>(largest_block, level.samples());
    largest_part = std::max<uint64_t>(largest_part, level.low().extent().samples());
    widest = std::max<uint64_t>(widest, level.x.block.size());
  }
  return sizeof(int32_t) * largest_part + kLiftingBytes * (widest + kAround) +
         (masked ? largest_block : 0);
}

WindowSynthesis::Target WindowSynthesis::targetOf(const Subband& subband) const {
  if (subband.orientation == Orientation::kLL) return {ll_x_, ll_y_, 0, ll_x_.size()};
  if (subband.level <= level_) return {{0, 0}, {0, 0}, 0, 0};
  const Level& level = at(subband.level);
  const size_t width = level.x.block.size();
  return {level.x.wanted(subband.isHighX()), level.y.wanted(subband.isHighY()),
          (subband.isHighY() ? width : 0) + (subband.isHighX() ? level.x.low.size() : 0),
          level.y.split() ? 2 * width : width};
}

int32_t* WindowSynthesis::valuesOf(const Subband& subband) {
  if (subband.orientation == Orientation::kLL) return ll_.data();
  return at(subband.level).values.data();
}

/// The coarsest of its levels reaches farthest.
bool WindowSynthesis::mayNeed(const Region& region) const {
  const int level = std::min(region.last_level, pyramid_->levels());
  if (region.isBase() || level < region.first_level) return true;
  if (level <= level_) return false;
  const Window low = at(level).low();
  const LowBand& band = pyramid_->low(level);
  const auto meets = [](uint32_t begin, uint32_t size, int splits, uint32_t first, uint32_t end) {
    return uint64_t{begin} << splits < end && first < (uint64_t{begin} + size) << splits;
  };
  return meets(low.x, low.width, band.splits_x, region.x0, region.x1) &&
         meets(low.y, low.height, band.splits_y, region.y0, region.y1);
}

bool WindowSynthesis::needs(const BandPart& part) const {
  const auto [columns, rows, first, pitch] = targetOf(pyramid_->subbands()[part.subband]);
  return part.column < columns.end && columns.begin < part.column + part.columns &&
         part.row < rows.end && rows.begin < part.row + part.rows;
}

void WindowSynthesis::put(const Band& band, int fraction_bits, const BandPart& part) {
  if (!needs(part) || !band.hasCells()) return;
  const Subband& subband = pyramid_->subbands()[part.subband];
  const Target target = targetOf(subband);
  const Reconstruction values(band, fraction_bits);
  std::vector<int32_t> line(part.columns);
  const uint32_t first = std::max(part.column, target.columns.begin),
                 last = std::min(part.column + part.columns, target.columns.end);
  for (uint32_t row = std::max(part.row, target.rows.begin);
       row < std::min(part.row + part.rows, target.rows.end); ++row) {
    values.row(row - part.row, line.data());
    std::copy(line.begin() + (first - part.column), line.begin() + (last - part.column),
              valuesOf(subband) + target.index(row) + (first - target.columns.begin));
  }
}

Window WindowSynthesis::needed(const Subband& subband) const {
  const auto [columns, rows, first, pitch] = targetOf(subband);
  return {columns.begin, rows.begin, columns.size(), rows.size()};
}

std::span<int32_t> WindowSynthesis::row(const Subband& subband, uint32_t row) {
  const Target target = targetOf(subband);
  return {valuesOf(subband) + target.index(target.rows.begin + row), target.columns.size()};
}

void WindowSynthesis::copyLow(const std::vector<int32_t>& low, int number) {
  Level& level = at(number);
  const Window part = level.low();
  const size_t width = level.x.block.size();
  const size_t pitch = level.y.split() ? 2 * width : width;
  assert(low.size() == part.extent().samples() && part.x >= level.x.low.begin);
  int32_t* const first =
      level.values.data() + (part.y - level.y.low.begin) * pitch + (part.x - level.x.low.begin);
  for (size_t row = 0; row < part.height; ++row)
    std::copy_n(low.data() + row * part.width, part.width, first + row * pitch);
}

std::vector<uint8_t> WindowSynthesis::maskOf(int level) const {
  if (pyramid_->allExist()) return {};
  return pyramid_->splitMask(level - 1, at(level).block());
}

/// A part of a ring ends as a part of any row does.
LevelTransform WindowSynthesis::transformOf(int level) const {
  WaveletSpec spec = spec_;
  spec.ring = spec_.ring && at(level).x.isWhole(pyramid_->low(level - 1).extent.width);
  return {spec, level, Direction::kSynthesis};
}

std::vector<int32_t> WindowSynthesis::run(uint32_t) {
  std::vector<int32_t> low = std::move(ll_);
  std::optional<HeldLadder> ladder;
  if (!pyramid_->held().none()) ladder.emplace(spec_, *pyramid_);
  for (int number = pyramid_->levels(); number > level_; --number) {
    Level& level = at(number);
    copyLow(low, number);
    const Window block = level.block();
    const HeldLevel states = ladder ? ladder->level(number) : HeldLevel{};
    std::optional<HeldBlock> held;
    if (ladder) held.emplace(*pyramid_, states, number, block);
    const std::vector<uint8_t> mask = maskOf(number);
    SplitBlock whole = level.split();
    whole.existing = mask;
    whole.held = held ? &*held : nullptr;
    transformOf(number).run(whole);
    // What the next finer level wants of it, or the window.
    Window wanted = number > level_ + 1 ? at(number - 1).low() : shown_.window;
    wanted.x -= block.x;
    wanted.y -= block.y;
    low = slice(std::span<const int32_t>(level.values), block.extent(), {0, wanted});
    level.values = std::vector<int32_t>();  // {} would keep its memory
  }
  takeOutGain(spec_, *pyramid_, level_, low);
  shown_.thin(low);
  return low;
}

std::vector<bool> neededParts(const ViewSynthesis& synthesis, std::span<const Subband> subbands,
                              const Region& region) {
  std::vector<bool> needed;
  if (!synthesis.mayNeed(region)) return needed;
  bool any = false;
  for (const BandPart& part : partsOf(subbands, region)) {
    needed.push_back(synthesis.needs(part));
    any |= needed.back();
  }
  if (!any) needed.clear();
  return needed;
}

}  // namespace tetrakis::inline synthesis
