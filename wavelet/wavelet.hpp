// SPDX-License-Identifier: Apache-2.0
// Reversible separable integer wavelet of a plane, for heights and for the components of a texture.
//
// Every level rounds, and the rounding errors of coarse levels spread over the whole plane. Planes
// with fraction bits keep these errors below a step. In planes without them (lossless ones) the low
// band is doubled after the levels of kDoubledLevels, so that rounding there costs half a step:
// prefixes get better, and lossless streams 0.5 % (terrain) to 0.9 % (images) longer.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "wavelet/lifting_filter.hpp"
#include "wavelet/masked_lifting.hpp"
#include "wavelet/subbands.hpp"

namespace tetrakis {

inline constexpr std::array<int, 2> kDoubledLevels = {3, 4};

/// Which transform: stands in the stream header.
struct WaveletSpec {
  static constexpr size_t kChoices = 3;
  std::array<FilterId, kChoices> filters{};  ///< of level 1, of level 2, of all coarser ones
  bool doubled = false;  ///< the low band is doubled after each of kDoubledLevels
  int bits = 0;          ///< of a sample, fraction included
  int finer_levels = 0;  ///< the plane is the low band after so many others, which count as levels

  static constexpr int kNarrowLevels = 3;

  /// Sums of this level are of 64 bits. Coarse low bands are larger than samples: they are doubled,
  /// and kOrthogonal multiplies their mean by 1.60 at every level.
  bool wide(int level) const {
    return level + finer_levels > kNarrowLevels || bits > widestSamples(filter(level));
  }
  FilterId filter(int level) const {
    return filters[std::min(static_cast<size_t>(level + finer_levels), kChoices) - 1];
  }
  /// The low band is doubled after this level.
  bool doubles(int level) const {
    return doubled && std::find(kDoubledLevels.begin(), kDoubledLevels.end(),
                                level + finer_levels) != kDoubledLevels.end();
  }
};

/// In place: width * height samples to coefficients, laid out as subbandsOf() says. Exactly undone
/// by inverseWavelet of the same spec and validity. Voids are left alone.
void forwardWavelet(const WaveletSpec& spec, std::span<int32_t> plane, uint32_t width,
                    uint32_t height, Validity valid = {}, uint32_t threads = 1);

/// Coefficients to samples. Defined for all values.
void inverseWavelet(const WaveletSpec& spec, std::span<int32_t> plane, uint32_t width,
                    uint32_t height, Validity valid = {}, uint32_t threads = 1);

/// One level of the inverse, of a block that stands for itself: whole.width * whole.height values
/// of which the first of a row and the even rows make up its low band (wavelet/subbands.hpp).
/// valid: of the block.
void inverseLevel(const WaveletSpec& spec, int level, std::span<int32_t> block, Extent whole,
                  Extent low, Validity valid = {});

/// Undoes the doubling of a value of the low band.
int32_t halved(int32_t value);

}  // namespace tetrakis
