// SPDX-License-Identifier: Apache-2.0
// Coding of corrections: one small integer a sample, row by row, mostly 0. They turn decoded
// heights into heights within a bound (after SPERR's outliers: S. Li, P. Lindstrom, J. Clyne 2023,
// but quantised to twice the bound) or into the very samples.
//
// A correction of magnitude m has the class bits(m). Decisions: class > 0, class > 1, ...; then the
// bits below the highest one and the sign at even odds. The contexts are a hint of the caller and
// the classes of the neighbours before: 2 W + 2 N + NW + NE.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/adaptive_bit.hpp"

namespace tetrakis {

/// What both sides know of the samples. Spans: width * height, row by row.
struct CorrectionGrid {
  uint32_t width = 0, height = 0;
  std::span<const uint8_t> valid;  ///< 1 valid, 0 void: void samples have no correction; empty: all
  std::span<const uint8_t> hints;  ///< below kHints
  static constexpr int kHints = 32;
};

/// Io is the encoder's or the decoder's side of a decision:
///   bool more(AdaptiveBit&, size_t sample, int depth)   the class of the correction exceeds depth
///   bool negative(size_t sample)
///   bool low(size_t sample, int position)               bit `position` of the magnitude
///   bool stopped()                                      the last decision did not count
/// Corrections after the first undecided one are 0.
template <class Io>
class CorrectionPass {
 public:
  CorrectionPass(const CorrectionGrid& grid, Io& io)
      : grid_(grid), io_(io), models_(size_t{CorrectionGrid::kHints} * kNeighbour) {}

  void run(std::span<int32_t> corrections) {
    // Classes of the row before and of this one, with a margin on both sides.
    std::vector<uint8_t> above(size_t{grid_.width} + 2, 0), classes(above);
    for (uint32_t y = 0; y < grid_.height; ++y) {
      for (uint32_t x = 0; x < grid_.width; ++x) {
        const size_t sample = size_t{y} * grid_.width + x;
        classes[x + 1] = 0;
        if (!grid_.valid.empty() && !grid_.valid[sample]) continue;
        const int sum = 2 * (classes[x] + above[x + 1]) + above[x] + above[x + 2];
        const uint32_t magnitude = code(sample, sum);
        if (io_.stopped()) return;
        if (magnitude == 0) continue;
        const bool negative = io_.negative(sample);
        if (io_.stopped()) return;
        corrections[sample] = static_cast<int32_t>(negative ? 0u - magnitude : magnitude);
        classes[x + 1] = static_cast<uint8_t>(std::bit_width(magnitude));
      }
      std::swap(above, classes);
    }
  }

 private:
  static constexpr int kMostBits = 32;
  static constexpr int kNeighbour = 10;  ///< classes of the neighbours' sum
  using Unary = std::array<AdaptiveBit, kMostBits>;

  static int neighbourContext(int sum) { return sum < 6 ? sum : std::min(6 + (sum - 6) / 12, 9); }

  uint32_t code(size_t sample, int sum) {
    const int context = grid_.hints[sample] * kNeighbour + neighbourContext(sum);
    Unary& unary = models_[static_cast<size_t>(context)];
    int bits = 0;
    while (bits < kMostBits && io_.more(unary[static_cast<size_t>(bits)], sample, bits)) ++bits;
    if (bits == 0 || io_.stopped()) return 0;
    uint32_t magnitude = uint32_t{1} << (bits - 1);
    for (int position = bits - 2; position >= 0; --position) {
      magnitude |= uint32_t{io_.low(sample, position)} << position;
    }
    return magnitude;
  }

  const CorrectionGrid& grid_;
  Io& io_;
  std::vector<Unary> models_;
};

}  // namespace tetrakis
