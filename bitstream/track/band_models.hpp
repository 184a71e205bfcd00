// SPDX-License-Identifier: Apache-2.0
// BandModels are the contexts of one class of bands. They start from means over terrain and aerial
// images, which saves what a small stream would otherwise spend on learning them: 0.7 % of the
// bytes in the mean over parts of 13 DEMs, up to 1.3 % on those of 257 x 257.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bitstream/coder/adaptive_bit.hpp"

namespace tetrakis::inline track {

struct BandModels {
  static constexpr int kLocal = 11;  ///< classes of the neighbours' magnitude sum
  static constexpr int kHint = 8;    ///< classes of the hint
  static constexpr int kReach = 3;   ///< of the distance to what is significant

  BandModels();

  std::array<std::array<AdaptiveBit, kHint>, kLocal> significance;
  /// One of four quiet neighbours becomes significant.
  std::array<std::array<AdaptiveBit, kHint>, kReach> group;
  std::array<AdaptiveBit, 3> group_place;  ///< the first that does: high bit, low bits
  std::array<AdaptiveBit, 9> refinement;
  std::array<AdaptiveBit, 5> sign;
  std::array<AdaptiveBit, 5> block;
  AdaptiveBit band;
};

/// What one neighbour adds to a sum at most: classes end at 30.
inline constexpr uint8_t kMostLocal = 30;

/// Class of a sum of the neighbours' magnitudes: 2 * near + far, in units of 2^plane, of which each
/// product is at most kMostLocal.
inline constexpr auto kLocalClass = [] {
  constexpr std::array<uint8_t, kMostLocal> kFirst = {0, 1, 2, 3, 4, 5, 5, 6, 6, 6, 7, 7, 7, 7, 8,
                                                      8, 8, 8, 8, 8, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9};
  std::array<uint8_t, 256> table{};
  for (size_t sum = 0; sum < table.size(); ++sum)
    table[sum] = sum < kFirst.size() ? kFirst[sum] : 10;
  return table;
}();

}  // namespace tetrakis::inline track
