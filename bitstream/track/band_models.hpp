// SPDX-License-Identifier: Apache-2.0
// BandModels predict the decisions of a band's coefficients, and so save most of their bytes. Their
// contexts are the sums of neighbouring magnitudes (localSums()) and hints from other bands
// (RowHints), which both sides know.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "bitstream/coder/adaptive_bit.hpp"
#include "bitstream/track/band.hpp"

namespace tetrakis::inline track {

// BandModels are the contexts of one class of bands. They start from means over terrain and aerial
// images, which saves what a small stream would otherwise spend on learning them: 0.7 % of the
// bytes in the mean over parts of 13 DEMs, up to 1.3 % on those of 257 x 257.

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

// localSums() adds up the magnitudes around each coefficient, in units of a bit-plane, for its
// contexts: near neighbours count twice, far ones once, and each product is at most kMostLocal.
// Eight bits hold the largest sum, so that vector units add many at a time.

/// The local sums of 32 coefficients of a row. Passes add to them what they learn, at most 2 each.
/// The last sum is added to, but never used.
using LocalSums = std::array<uint8_t, 33>;
static_assert(8 * kMostLocal + 2 <= 255);

/// first: index of the first cell. The sums are in units of 2^(band.plane + kAbove).
template <int kAbove = 0>
void localSums(const Band& band, size_t first, LocalSums& sums) {
  const auto stride = static_cast<ptrdiff_t>(band.shape.stride());
  const uint8_t* here = band.scaled.data() + first;
  const uint8_t *above = here - stride, *below = here + stride;
  const auto near = [](uint8_t scaled) {
    const auto twice = static_cast<uint8_t>((scaled >> kAbove) << 1);
    return std::min(twice, kMostLocal);
  };
  const auto far = [](uint8_t scaled) {
    return std::min(static_cast<uint8_t>(scaled >> kAbove), kMostLocal);
  };
  for (ptrdiff_t i = 0; i < 32; ++i) {
    sums[static_cast<size_t>(i)] = static_cast<uint8_t>(
        near(here[i - 1]) + near(here[i + 1]) + near(above[i]) + near(below[i]) +
        far(above[i - 1]) + far(above[i + 1]) + far(below[i - 1]) + far(below[i + 1]));
  }
}

/// The local sum of one coefficient, in units of 2^plane.
inline uint8_t localSum(const Band& band, size_t cell, int plane) {
  const Neighbours neighbours(band.shape, band.orientation);
  const auto scaled = [&](ptrdiff_t offset) {
    return band.magnitude[cell + static_cast<size_t>(offset)] >> plane;
  };
  uint32_t sum = 0;
  for (const ptrdiff_t near : neighbours.near)
    sum += std::min<uint32_t>(2 * std::min(scaled(near), 0x7fu), kMostLocal);
  for (const ptrdiff_t far : neighbours.far) sum += std::min<uint32_t>(scaled(far), kMostLocal);
  return static_cast<uint8_t>(sum);
}

// RowHints tells how large the coefficients of a band may be from three other bands: its parent,
// the same band of another colour plane, and its siblings, the other details of its level (as X. Wu
// does in "High-order context modeling and embedded conditional entropy coding of wavelet
// coefficients for image compression", Asilomar 1997).

/// The bands that hint at the magnitudes of another; null where there is none.
struct HintBands {
  const Band* parent = nullptr;
  const Band* companion = nullptr;
  std::array<const Band*, 2> siblings{};
};

/// Hints for 32 columns of a row.
class RowHints {
 public:
  RowHints() = default;
  RowHints(const HintBands& bands, uint32_t row, uint32_t word)
      : parent_(at(bands.parent, row / 2, 16 * word)),
        companion_(at(bands.companion, row, 32 * word)),
        siblings_{at(bands.siblings[0], row, 32 * word), at(bands.siblings[1], row, 32 * word)} {}

  /// The sum of the hints at column i.
  uint32_t ofOne(uint32_t i) const {
    return parent_[i / 2] + companion_[i] + siblings_[0][i] + siblings_[1][i];
  }

  /// Twice the bits that are set in any hint at the four columns from i on.
  uint32_t ofFour(uint32_t i) const {
    const uint32_t *c = companion_ + i, *s = siblings_[0] + i, *t = siblings_[1] + i;
    const uint64_t any = twoOf(parent_ + i / 2) | twoOf(c) | twoOf(c + 2) | twoOf(s) |
                         twoOf(s + 2) | twoOf(t) | twoOf(t + 2);
    return 2 * (static_cast<uint32_t>(any) | static_cast<uint32_t>(any >> 32));
  }

 private:
  static uint64_t twoOf(const uint32_t* magnitudes) {
    uint64_t both;
    std::memcpy(&both, magnitudes, sizeof both);
    return both;
  }

  /// Siblings may lack the last row, which then is margin, and the last column.
  static const uint32_t* at(const Band* band, uint32_t row, uint32_t column) {
    static constexpr std::array<uint32_t, 32> kNone{};
    const bool any = band != nullptr && band->hasCells() && column < 32 * band->shape.words();
    if (!any) return kNone.data();
    return band->magnitude.data() + band->shape.cell(row, column);
  }

  const uint32_t *parent_ = nullptr, *companion_ = nullptr;
  std::array<const uint32_t*, 2> siblings_{};
};

}  // namespace tetrakis::inline track
