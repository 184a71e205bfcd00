// SPDX-License-Identifier: Apache-2.0
#include "wavelet/window.hpp"

#include <algorithm>
#include <cassert>

#include "bitstream/track/reconstruction.hpp"

namespace tetrakis {

namespace {

bool isHighX(Orientation orientation) {
  return orientation == Orientation::kHL || orientation == Orientation::kHH;
}

bool isHighY(Orientation orientation) {
  return orientation == Orientation::kLH || orientation == Orientation::kHH;
}

}  // namespace

/// A sample needs the places within the filter's reach; what the block's own ends do to the filter
/// stays outside of `needed`. Where the block ends with the plane both are mirrored alike.
WindowSynthesis::Axis WindowSynthesis::axisOf(Range needed, uint32_t size, int level,
                                              int splits) const {
  if (size <= kSmallestSide) return {needed, needed, {0, 0}, splits};
  const uint32_t reach = synthesisReach(spec_.filter(level));
  const uint32_t begin = (needed.begin - std::min(needed.begin, reach)) & ~uint32_t{1};
  const uint32_t end = needed.end + std::min(size - needed.end, reach);
  return {{begin, end}, {begin / 2, (end + 1) / 2}, {begin / 2, end / 2}, splits};
}

WindowSynthesis::WindowSynthesis(const WaveletSpec& spec, std::span<const Subband> subbands,
                                 uint32_t width, uint32_t height, const Window& window)
    : spec_(spec),
      subbands_(subbands),
      width_(width),
      window_(window),
      ll_x_{window.x, window.x + window.width},
      ll_y_{window.y, window.y + window.height} {
  assert(window.width > 0 && window.height > 0);
  assert(ll_x_.end <= width && ll_y_.end <= height);
  const std::vector<Extent> extents = lowExtents(width, height);
  int splits_x = 0, splits_y = 0;
  for (size_t l = 1; l < extents.size(); ++l) {
    const Extent whole = extents[l - 1];
    Level level{axisOf(ll_x_, whole.width, static_cast<int>(l), splits_x),
                axisOf(ll_y_, whole.height, static_cast<int>(l), splits_y),
                {}};
    ll_x_ = level.x.low;
    ll_y_ = level.y.low;
    splits_x += level.x.split();
    splits_y += level.y.split();
    levels_.push_back(std::move(level));
  }
}

void WindowSynthesis::allocate() {
  for (Level& level : levels_) level.values.resize(level.samples());
  ll_.resize(size_t{ll_x_.size()} * ll_y_.size());
}

uint64_t WindowSynthesis::samples() const {
  uint64_t sum = uint64_t{ll_x_.size()} * ll_y_.size();
  for (const Level& level : levels_) sum += level.samples();
  return sum;
}

uint64_t WindowSynthesis::largestBlock() const {
  uint64_t largest = 0;
  for (const Level& level : levels_) largest = std::max<uint64_t>(largest, level.samples());
  return largest;
}

uint64_t WindowSynthesis::largestPart() const {
  uint64_t largest = uint64_t{window_.width} * window_.height;
  for (const Level& level : levels_)
    largest = std::max(largest, uint64_t{level.x.low.size()} * level.y.low.size());
  return largest;
}

WindowSynthesis::Target WindowSynthesis::targetOf(const Subband& subband) {
  if (subband.orientation == Orientation::kLL) return {ll_x_, ll_y_, &ll_, 0, ll_x_.size()};
  Level& level = levels_[static_cast<size_t>(subband.level - 1)];
  const bool high_x = isHighX(subband.orientation), high_y = isHighY(subband.orientation);
  const size_t width = level.x.block.size();
  return {level.x.wanted(high_x), level.y.wanted(high_y), &level.values,
          (high_y ? width : 0) + (high_x ? level.x.low.size() : 0),
          level.y.split() ? 2 * width : width};
}

bool WindowSynthesis::needs(const BandPart& part) const {
  const Subband& subband = subbands_[part.subband];
  Range columns = ll_x_, rows = ll_y_;
  if (subband.orientation != Orientation::kLL) {
    const Level& level = levels_[static_cast<size_t>(subband.level - 1)];
    columns = level.x.wanted(isHighX(subband.orientation));
    rows = level.y.wanted(isHighY(subband.orientation));
  }
  return part.column < columns.end && columns.begin < part.column + part.columns &&
         part.row < rows.end && rows.begin < part.row + part.rows;
}

void WindowSynthesis::put(const Band& band, int fraction_bits, const BandPart& part) {
  if (!needs(part)) return;
  const Target target = targetOf(subbands_[part.subband]);
  const Reconstruction values(band, fraction_bits);
  std::vector<int32_t> line(part.columns);
  const uint32_t first = std::max(part.column, target.columns.begin),
                 last = std::min(part.column + part.columns, target.columns.end);
  for (uint32_t row = std::max(part.row, target.rows.begin);
       row < std::min(part.row + part.rows, target.rows.end); ++row) {
    values.row(row - part.row, line.data());
    int32_t* out =
        target.values->data() + target.first + (row - target.rows.begin) * target.row_pitch;
    std::copy(line.begin() + (first - part.column), line.begin() + (last - part.column),
              out + (first - target.columns.begin));
  }
}

uint32_t WindowSynthesis::rows(const Subband& subband) {
  return targetOf(subband).rows.size();
}

std::span<int32_t> WindowSynthesis::row(const Subband& subband, uint32_t row) {
  const Target target = targetOf(subband);
  return {target.values->data() + target.first + row * target.row_pitch, target.columns.size()};
}

void WindowSynthesis::copyLow(const std::vector<int32_t>& low, int number) {
  Level& level = levels_[static_cast<size_t>(number - 1)];
  const size_t columns = level.x.low.size(), width = level.x.block.size();
  const size_t pitch = level.y.split() ? 2 * width : width;
  for (size_t row = 0; row < level.y.low.size(); ++row) {
    int32_t* out = level.values.data() + row * pitch;
    std::copy_n(low.data() + row * columns, columns, out);
    if (!spec_.doubles(number)) continue;
    for (size_t i = 0; i < columns; ++i) out[i] = halved(out[i]);
  }
}

std::vector<uint8_t> WindowSynthesis::validityOf(const Level& level, Validity valid) const {
  std::vector<uint8_t> out;
  if (valid.empty()) return out;
  out.reserve(level.values.size());
  for (uint32_t y = level.y.block.begin; y < level.y.block.end; ++y) {
    const uint8_t* row = valid.data() + (size_t{y} << level.y.splits) * width_;
    for (uint32_t x = level.x.block.begin; x < level.x.block.end; ++x)
      out.push_back(row[size_t{x} << level.x.splits]);
  }
  return out;
}

std::vector<int32_t> WindowSynthesis::run(Validity valid) {
  std::vector<int32_t> low = std::move(ll_);
  for (auto number = static_cast<int>(levels_.size()); number >= 1; --number) {
    Level& level = levels_[static_cast<size_t>(number - 1)];
    copyLow(low, number);
    const uint32_t width = level.x.block.size();
    inverseLevel(spec_, number, level.values, {width, level.y.block.size()},
                 {level.x.low.size(), level.y.low.size()}, validityOf(level, valid));
    // What the next finer level wants of it, or the window.
    Window wanted = window_;
    if (number > 1) {
      const Level& finer = levels_[static_cast<size_t>(number - 2)];
      wanted = {finer.x.low.begin, finer.y.low.begin, finer.x.low.size(), finer.y.low.size()};
    }
    wanted.x -= level.x.block.begin;
    wanted.y -= level.y.block.begin;
    low = crop(std::span<const int32_t>(level.values), width, wanted);
    level.values = std::vector<int32_t>();  // {} would keep its memory
  }
  return low;
}

}  // namespace tetrakis
