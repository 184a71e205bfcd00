// SPDX-License-Identifier: Apache-2.0
// WaveletSpec says which transform a plane has, level by level, and how wide its sums are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "codec/wavelet/lifting/joint_lifting.hpp"
#include "codec/wavelet/lifting/lifting_filter.hpp"

namespace tetrakis::inline wavelet {

/// The header of a stream says it.
struct WaveletSpec {
  static constexpr size_t kChoices = 3;
  std::array<FilterId, kChoices> filters{};  ///< of level 1, of level 2, of all coarser ones
  bool whole = false;                        ///< samples have no fraction bits
  int bits = 0;                              ///< of a sample, fraction included
  int first_doubled = 3;  ///< the low band is doubled after this level and the next two; 0: never
  bool ring = false;      ///< the last column of the plane lies beside its first one

  static constexpr int kDoubled = 3;  ///< levels that double their low bands
  static constexpr int kNarrowLevels = 3;
  static constexpr int kJointBits = 20;

  /// Sums of this level are of 64 bits. Coarse low bands are larger than samples: they are doubled,
  /// and kQuiet and kOrthogonal multiply their mean by 1.71 and 1.60 at every level.
  bool wide(int level) const {
    return level > kNarrowLevels || bits > widestSamples(filter(level));
  }
  FilterId filter(int level) const {
    return filters[std::min(static_cast<size_t>(level), kChoices) - 1];
  }
  /// The low band is doubled after this level.
  bool doubles(int level) const {
    return whole && first_doubled > 0 && level >= first_doubled && level < first_doubled + kDoubled;
  }
  /// The level lifts rows and columns jointly where it splits both and every sample exists.
  bool joint(int level) const { return whole && bits <= kJointBits && liftsJointly(filter(level)); }
  /// Joint sums of this level are of 64 bits: they have kJointPlaces binary places.
  bool jointlyWide(int level) const {
    return level > kNarrowLevels || bits + kJointPlaces >= widestSamples(filter(level));
  }
};

}  // namespace tetrakis::inline wavelet
