// SPDX-License-Identifier: Apache-2.0
// RowHints tells how large the coefficients of a band may be from three other bands: its parent,
// the same band of another colour plane, and its siblings, the other details of its level (as X. Wu
// does in "High-order context modeling and embedded conditional entropy coding of wavelet
// coefficients for image compression", Asilomar 1997).
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "bitstream/track/band.hpp"

namespace tetrakis::inline track {

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
