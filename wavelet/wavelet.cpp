// SPDX-License-Identifier: Apache-2.0
// The order of the levels, and how rows and columns get into a LiftingLine and back.
#include "wavelet/wavelet.hpp"

#include <algorithm>
#include <cassert>

#include "wavelet/lifting.hpp"

namespace tetrakis {

namespace {

constexpr uint32_t kLanes = LiftingLine::kLanes;

bool isDoubled(const WaveletSpec& spec, size_t level) {
  return spec.doubled && std::find(kDoubledLevels.begin(), kDoubledLevels.end(),
                                   static_cast<int>(level)) != kDoubledLevels.end();
}

/// One level on the upper left corner of a plane.
class Split {
 public:
  Split(std::span<int32_t> plane, uint32_t width, uint32_t height)
      : plane_(plane.data()),
        stride_(width),
        row_(width, 1),
        columns_(height, std::min(width, kLanes)) {}

  void forwardRows(Extent extent, FilterId filter, bool wide) {
    row_.resize(extent.width, 1);
    int32_t *low = row_.low(0), *high = row_.high(0);
    const uint32_t lows = row_.lows(), highs = row_.highs();
    for (uint32_t y = 0; y < extent.height; ++y) {
      int32_t* row = at(0, y);
      for (uint32_t i = 0; i < highs; ++i) {
        low[i] = row[2 * i];
        high[i] = row[2 * i + 1];
      }
      if (lows > highs) low[highs] = row[2 * highs];
      row_.analyse(filter, wide);
      std::copy_n(low, lows, row);
      std::copy_n(high, highs, row + lows);
    }
  }

  void inverseRows(Extent extent, FilterId filter, bool wide) {
    row_.resize(extent.width, 1);
    int32_t *low = row_.low(0), *high = row_.high(0);
    const uint32_t lows = row_.lows(), highs = row_.highs();
    for (uint32_t y = 0; y < extent.height; ++y) {
      int32_t* row = at(0, y);
      std::copy_n(row, lows, low);
      std::copy_n(row + lows, highs, high);
      row_.synthesise(filter, wide);
      for (uint32_t i = 0; i < highs; ++i) {
        row[2 * i] = low[i];
        row[2 * i + 1] = high[i];
      }
      if (lows > highs) row[2 * highs] = low[highs];
    }
  }

  void forwardColumns(Extent extent, FilterId filter, bool wide) {
    for (uint32_t x = 0; x < extent.width; x += kLanes) {
      const uint32_t lanes = std::min(kLanes, extent.width - x);
      columns_.resize(extent.height, lanes);
      for (uint32_t y = 0; y < extent.height; ++y) std::copy_n(at(x, y), lanes, columns_.sample(y));
      columns_.analyse(filter, wide);
      for (uint32_t y = 0; y < extent.height; ++y)
        std::copy_n(columns_.coefficient(y), lanes, at(x, y));
    }
  }

  void inverseColumns(Extent extent, FilterId filter, bool wide) {
    for (uint32_t x = 0; x < extent.width; x += kLanes) {
      const uint32_t lanes = std::min(kLanes, extent.width - x);
      columns_.resize(extent.height, lanes);
      for (uint32_t y = 0; y < extent.height; ++y)
        std::copy_n(at(x, y), lanes, columns_.coefficient(y));
      columns_.synthesise(filter, wide);
      for (uint32_t y = 0; y < extent.height; ++y) std::copy_n(columns_.sample(y), lanes, at(x, y));
    }
  }

  void doubleLow(Extent low) {
    for (uint32_t y = 0; y < low.height; ++y) {
      for (int32_t& value : std::span(at(0, y), low.width)) {
        value = static_cast<int32_t>(static_cast<uint32_t>(value) << 1);
      }
    }
  }

  void halveLow(Extent low) {
    for (uint32_t y = 0; y < low.height; ++y) {
      for (int32_t& value : std::span(at(0, y), low.width)) {
        value = static_cast<int32_t>(static_cast<uint32_t>(value) + 1) >> 1;
      }
    }
  }

 private:
  int32_t* at(uint32_t x, uint32_t y) { return plane_ + y * stride_ + x; }

  int32_t* plane_;
  size_t stride_;
  LiftingLine row_, columns_;
};

}  // namespace

void forwardWavelet(const WaveletSpec& spec, std::span<int32_t> plane, uint32_t width,
                    uint32_t height) {
  assert(plane.size() == size_t{width} * height && width > 0 && height > 0);
  const std::vector<Extent> extents = lowExtents(width, height);
  Split split(plane, width, height);
  for (size_t l = 1; l < extents.size(); ++l) {
    const Extent whole = extents[l - 1], low = extents[l];
    const FilterId filter = spec.filter(static_cast<int>(l));
    if (low.width < whole.width) split.forwardRows(whole, filter, spec.wide);
    if (low.height < whole.height) split.forwardColumns(whole, filter, spec.wide);
    if (isDoubled(spec, l)) split.doubleLow(low);
  }
}

void inverseWavelet(const WaveletSpec& spec, std::span<int32_t> plane, uint32_t width,
                    uint32_t height) {
  assert(plane.size() == size_t{width} * height && width > 0 && height > 0);
  const std::vector<Extent> extents = lowExtents(width, height);
  Split split(plane, width, height);
  for (size_t l = extents.size() - 1; l >= 1; --l) {
    const Extent whole = extents[l - 1], low = extents[l];
    const FilterId filter = spec.filter(static_cast<int>(l));
    if (isDoubled(spec, l)) split.halveLow(low);
    if (low.height < whole.height) split.inverseColumns(whole, filter, spec.wide);
    if (low.width < whole.width) split.inverseRows(whole, filter, spec.wide);
  }
}

}  // namespace tetrakis
