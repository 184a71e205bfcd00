// SPDX-License-Identifier: Apache-2.0
// The plane at half, a quarter, ... of its resolution: level k has the samples at multiples of 2^k
// in x and y. It is the low band after k levels of the transform, so it takes no inverse of the
// finer ones; what their filters and doublings have made of constants is taken back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wavelet/band_plan.hpp"
#include "wavelet/wavelet.hpp"

namespace tetrakis {

class MipLevel {
 public:
  /// level: 0 (the plane itself) to coarsestLevel(width, height).
  MipLevel(uint32_t width, uint32_t height, int level);

  static int coarsestLevel(uint32_t width, uint32_t height);

  int level() const { return level_; }

  /// ceil(width / 2^level) x ceil(height / 2^level).
  Extent size() const { return size_; }
  size_t samples() const { return size_t{size_.width} * size_.height; }
  /// The low band, a plane of its own: its subbands are the first of the whole plane's. It is
  /// larger than size() where a side is too short to be split so often.
  Extent low() const { return low_; }
  /// The transform of the low band.
  WaveletSpec transform(const WaveletSpec& whole) const;

  /// Says which bands are not needed. bands: those of the parts.
  void dropFiner(std::span<const BandPart> parts, std::span<BandPlan> bands) const;

  /// The validity of the low band's samples. valid, width: of the whole plane.
  std::vector<uint8_t> maskOf(Validity valid, uint32_t width) const;

  /// Takes the gain of the finer levels out of the low band. whole: their transform.
  void normalise(const WaveletSpec& whole, std::span<int32_t> low) const;

  /// Of the values of the low band's samples leaves those of the level's, in front.
  template <class T>
  void thin(std::span<T> values) const {
    if (values.size() <= samples()) return;
    for (uint32_t y = 0; y < size_.height; ++y) {
      for (uint32_t x = 0; x < size_.width; ++x) {
        const size_t from =
            (size_t{y} << (level_ - splits_y_)) * low_.width + (size_t{x} << (level_ - splits_x_));
        values[size_t{y} * size_.width + x] = values[from];
      }
    }
  }

 private:
  int level_;
  Extent size_, low_;
  int splits_x_ = 0, splits_y_ = 0;  ///< of the finer levels
};

}  // namespace tetrakis
