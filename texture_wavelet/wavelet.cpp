// SPDX-License-Identifier: Apache-2.0
// The lifting steps, one kernel for rows and columns, and the order of the levels (see
// wavelet.hpp).
#include "texture_wavelet/wavelet.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace tetrakis {
namespace {

constexpr uint32_t kLanes = 32;   // columns lifted together: two cache lines of each row
constexpr ptrdiff_t kMargin = 3;  // mirrored elements on either side: half the taps
constexpr int kWeightBits = 8;

struct Size {
  uint32_t width, height;
};

uint32_t lowOf(uint32_t side) {
  return side > kSmallestSide ? side - side / 2 : side;
}

/// Sizes of the low bands: [0] the image, [l] after level l.
std::vector<Size> lowSizes(uint32_t width, uint32_t height) {
  std::vector<Size> sizes = {{width, height}};
  while (std::max(sizes.back().width, sizes.back().height) > kSmallestSide) {
    sizes.push_back({lowOf(sizes.back().width), lowOf(sizes.back().height)});
  }
  assert(sizes.size() <= kMaxWaveletLevels + 1);
  return sizes;
}

/// Position p of a signal of n >= 2 samples that is mirrored about both ends.
ptrdiff_t mirror(ptrdiff_t p, ptrdiff_t n) {
  const ptrdiff_t period = 2 * (n - 1);
  p = ((p % period) + period) % period;
  return std::min(p, period - p);
}

/// target[j] += or -= the rounded six-tap sum about source[j] and source[j + lanes]. Elements are
/// `lanes` values apart, so that one loop serves rows (1 lane) and strips of columns.
template <bool kAdd, int kW0, int kW1, int kW2>
void lift(int32_t* __restrict target, const int32_t* __restrict source, ptrdiff_t count,
          ptrdiff_t lanes) {
  const auto pair = [&](ptrdiff_t a, ptrdiff_t b) {
    return static_cast<uint32_t>(source[a]) + static_cast<uint32_t>(source[b]);
  };
  for (ptrdiff_t j = 0; j < count * lanes; ++j) {
    const uint32_t sum = static_cast<uint32_t>(kW0) * pair(j, j + lanes) +
                         static_cast<uint32_t>(kW1) * pair(j - lanes, j + 2 * lanes) +
                         static_cast<uint32_t>(kW2) * pair(j - 2 * lanes, j + 3 * lanes) +
                         (1u << (kWeightBits - 1));
    const auto change = static_cast<uint32_t>(static_cast<int32_t>(sum) >> kWeightBits);
    const auto value = static_cast<uint32_t>(target[j]);
    target[j] = static_cast<int32_t>(kAdd ? value + change : value - change);
  }
}

/// A signal of `length` elements of `lanes` values, its even and odd elements apart, with margins.
class Signal {
 public:
  explicit Signal(size_t longest_values)
      : even_(longest_values / 2 + (2 * kMargin + 1) * kLanes), odd_(even_.size()) {}

  void resize(uint32_t length, uint32_t lanes) {
    length_ = length;
    lanes_ = lanes;
  }
  uint32_t lows() const { return static_cast<uint32_t>(length_ - length_ / 2); }
  uint32_t highs() const { return static_cast<uint32_t>(length_ / 2); }
  int32_t* low(ptrdiff_t i) { return even_.data() + (i + kMargin) * lanes_; }
  int32_t* high(ptrdiff_t i) { return odd_.data() + (i + kMargin) * lanes_; }

  void analyse() {
    mirrorLow();
    lift<false, 147, -28, 9>(high(0), low(0), highs(), lanes_);
    mirrorHigh();
    lift<true, 78, -20, 6>(low(0), high(-1), lows(), lanes_);
  }
  void synthesise() {
    mirrorHigh();
    lift<false, 78, -20, 6>(low(0), high(-1), lows(), lanes_);
    mirrorLow();
    lift<true, 147, -28, 9>(high(0), low(0), highs(), lanes_);
  }

 private:
  // Mirroring keeps even positions even (the ends are mirrored about samples), so each half has its
  // margins from itself.
  void mirrorLow() {
    for (ptrdiff_t i = 1; i <= kMargin; ++i) {
      const ptrdiff_t last = lows() - 1;
      std::copy_n(low(mirror(-2 * i, length_) / 2), lanes_, low(-i));
      std::copy_n(low(mirror(2 * (last + i), length_) / 2), lanes_, low(last + i));
    }
  }
  void mirrorHigh() {
    for (ptrdiff_t i = 1; i <= kMargin; ++i) {
      const ptrdiff_t last = highs() - 1;
      std::copy_n(high(mirror(1 - 2 * i, length_) / 2), lanes_, high(-i));
      std::copy_n(high(mirror(2 * (last + i) + 1, length_) / 2), lanes_, high(last + i));
    }
  }

  std::vector<int32_t> even_, odd_;
  ptrdiff_t length_ = 0, lanes_ = 0;
};

/// One level on the upper left corner of a plane.
class Level {
 public:
  Level(int32_t* plane, size_t stride, Signal& signal)
      : plane_(plane), stride_(stride), signal_(signal) {}

  void splitRows(Size size) {
    signal_.resize(size.width, 1);
    int32_t *low = signal_.low(0), *high = signal_.high(0);
    const uint32_t lows = signal_.lows(), highs = signal_.highs();
    for (uint32_t y = 0; y < size.height; ++y) {
      int32_t* row = plane_ + y * stride_;
      for (uint32_t i = 0; i < highs; ++i) {
        low[i] = row[2 * i];
        high[i] = row[2 * i + 1];
      }
      if (lows > highs) low[highs] = row[2 * highs];
      signal_.analyse();
      std::copy_n(low, lows, row);
      std::copy_n(high, highs, row + lows);
    }
  }

  void mergeRows(Size size) {
    signal_.resize(size.width, 1);
    int32_t *low = signal_.low(0), *high = signal_.high(0);
    const uint32_t lows = signal_.lows(), highs = signal_.highs();
    for (uint32_t y = 0; y < size.height; ++y) {
      int32_t* row = plane_ + y * stride_;
      std::copy_n(row, lows, low);
      std::copy_n(row + lows, highs, high);
      signal_.synthesise();
      for (uint32_t i = 0; i < highs; ++i) {
        row[2 * i] = low[i];
        row[2 * i + 1] = high[i];
      }
      if (lows > highs) row[2 * highs] = low[highs];
    }
  }

  void splitColumns(Size size) {
    for (uint32_t x = 0; x < size.width; x += kLanes) {
      const uint32_t lanes = std::min(kLanes, size.width - x);
      signal_.resize(size.height, lanes);
      for (uint32_t y = 0; y < size.height; ++y) std::copy_n(at(x, y), lanes, interleaved(y));
      signal_.analyse();
      for (uint32_t y = 0; y < size.height; ++y) std::copy_n(separated(y), lanes, at(x, y));
    }
  }

  void mergeColumns(Size size) {
    for (uint32_t x = 0; x < size.width; x += kLanes) {
      const uint32_t lanes = std::min(kLanes, size.width - x);
      signal_.resize(size.height, lanes);
      for (uint32_t y = 0; y < size.height; ++y) std::copy_n(at(x, y), lanes, separated(y));
      signal_.synthesise();
      for (uint32_t y = 0; y < size.height; ++y) std::copy_n(interleaved(y), lanes, at(x, y));
    }
  }

  void doubleLow(Size low) {
    for (uint32_t y = 0; y < low.height; ++y) {
      for (int32_t& value : std::span(at(0, y), low.width)) {
        value = static_cast<int32_t>(static_cast<uint32_t>(value) << 1);
      }
    }
  }

  void halveLow(Size low) {
    for (uint32_t y = 0; y < low.height; ++y) {
      for (int32_t& value : std::span(at(0, y), low.width)) {
        value = static_cast<int32_t>(static_cast<uint32_t>(value) + 1) >> 1;
      }
    }
  }

 private:
  int32_t* at(uint32_t x, uint32_t y) { return plane_ + y * stride_ + x; }
  int32_t* interleaved(uint32_t y) { return y % 2 == 0 ? signal_.low(y / 2) : signal_.high(y / 2); }
  int32_t* separated(uint32_t y) {
    return y < signal_.lows() ? signal_.low(y) : signal_.high(ptrdiff_t{y} - signal_.lows());
  }

  int32_t* plane_;
  size_t stride_;
  Signal& signal_;
};

bool isDoubled(size_t level) {
  return std::find(kDoubledLevels.begin(), kDoubledLevels.end(), static_cast<int>(level)) !=
         kDoubledLevels.end();
}

size_t longestSignal(uint32_t width, uint32_t height) {
  return std::max<size_t>(width, size_t{height} * std::min(width, kLanes)) + kLanes;
}

}  // namespace

std::vector<Subband> subbandsOf(uint32_t width, uint32_t height) {
  const std::vector<Size> sizes = lowSizes(width, height);
  const auto levels = static_cast<int>(sizes.size()) - 1;
  std::vector<Subband> bands;
  // Finest first, each level backwards; reversed at the end.
  int splits_x = 0, splits_y = 0;
  for (int level = 1; level <= levels; ++level) {
    const Size whole = sizes[static_cast<size_t>(level - 1)],
               low = sizes[static_cast<size_t>(level)];
    splits_x += low.width < whole.width;
    splits_y += low.height < whole.height;
    const uint32_t high_width = whole.width - low.width, high_height = whole.height - low.height;
    bands.push_back({level, Orientation::kHH, low.width, low.height, high_width, high_height,
                     splits_x, splits_y});
    bands.push_back(
        {level, Orientation::kLH, 0, low.height, low.width, high_height, splits_x, splits_y});
    bands.push_back(
        {level, Orientation::kHL, low.width, 0, high_width, low.height, splits_x, splits_y});
  }
  bands.push_back({levels, Orientation::kLL, 0, 0, sizes.back().width, sizes.back().height,
                   splits_x, splits_y});
  std::reverse(bands.begin(), bands.end());
  return bands;
}

void forwardWavelet(std::span<int32_t> plane, uint32_t width, uint32_t height) {
  assert(plane.size() == size_t{width} * height && width > 0 && height > 0);
  const std::vector<Size> sizes = lowSizes(width, height);
  Signal signal(longestSignal(width, height));
  Level level(plane.data(), width, signal);
  for (size_t l = 1; l < sizes.size(); ++l) {
    const Size whole = sizes[l - 1], low = sizes[l];
    if (low.width < whole.width) level.splitRows(whole);
    if (low.height < whole.height) level.splitColumns(whole);
    if (isDoubled(l)) level.doubleLow(low);
  }
}

void inverseWavelet(std::span<int32_t> plane, uint32_t width, uint32_t height) {
  assert(plane.size() == size_t{width} * height && width > 0 && height > 0);
  const std::vector<Size> sizes = lowSizes(width, height);
  Signal signal(longestSignal(width, height));
  Level level(plane.data(), width, signal);
  for (size_t l = sizes.size() - 1; l >= 1; --l) {
    const Size whole = sizes[l - 1], low = sizes[l];
    if (isDoubled(l)) level.halveLow(low);
    if (low.height < whole.height) level.mergeColumns(whole);
    if (low.width < whole.width) level.mergeRows(whole);
  }
}

}  // namespace tetrakis
