// SPDX-License-Identifier: Apache-2.0
// A correction is a small integer, mostly 0, and every sample has one. Corrections turn decoded
// heights into heights within a bound (after SPERR's outliers: S. Li, P. Lindstrom, J. Clyne 2023,
// but quantised to twice the bound) or into the very samples. They are coded row by row.
//
// A correction of magnitude m has the class bits(m). The coder decides whether the class exceeds 0,
// then 1, and so on; then it codes the sign, and the bits below the highest one, of which all but
// the first are at even odds. The contexts are a hint of the caller, the classes of the neighbours
// before (2 W + 2 N + NW + NE), and their signs, because the errors of a cut oscillate from sample
// to sample. Against signs at
// even odds that saves 2 to 15 % of the corrections.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/coder/adaptive_bit.hpp"

namespace tetrakis::inline corrections {

/// What both sides know of the samples: a hint for each, below kHints. Samples that do not exist
/// have no correction.
using CorrectionHints = PlaneView<const uint8_t>;
inline constexpr int kHints = 32;

/// Io is the encoder's or the decoder's side of a decision:
///   bool more(AdaptiveBit&, size_t sample, int depth)   the class of the correction exceeds depth
///   bool negative(AdaptiveBit&, size_t sample, bool flip)   negative, xor flip
///   bool high(AdaptiveBit&, size_t sample, int position)    bit `position` of the magnitude
///   bool low(size_t sample, int position)                   the same at even odds
///   bool stopped()                                          the last decision did not count
///   void take(size_t first, std::span<const int32_t> row)   corrections from sample `first` on
template <class Io>
class CorrectionPass {
 public:
  CorrectionPass(const CorrectionHints& hints, Io& io)
      : hints_(hints), io_(io), any_(size_t{kHints} * kQuiet), more_(size_t{kHints} * kNeighbour) {}

  /// Io takes the corrections row by row, up to the first undecided one.
  void run() {
    std::vector<int32_t> row(hints_.width);
    // The row before and this one, with a margin on both sides.
    std::vector<Known> above(size_t{hints_.width} + 2), here(above);
    for (uint32_t y = 0; y < hints_.height; ++y) {
      const size_t first = size_t{y} * hints_.width;
      for (uint32_t x = 0; x < hints_.width; ++x) {
        here[x + 1] = {};
        row[x] = 0;
        if (!hints_.valid[first + x]) continue;
        row[x] = code(first + x, {here[x], above[x + 1], above[x], above[x + 2]});
        if (io_.stopped()) return io_.take(first, std::span(row).first(x));
        here[x + 1] = Known(row[x]);
      }
      io_.take(first, row);
      std::swap(above, here);
    }
  }

 private:
  static constexpr int kMostBits = 32;
  static constexpr int kNeighbour = 10;  ///< contexts of the neighbours' classes
  static constexpr int kQuiet = 6;       ///< those of them in which no magnitude exceeds 1
  static constexpr int kSigns = 41;      ///< signs of four neighbours, up to reversal of all
  using Signs = std::array<AdaptiveBit, kSigns>;
  using Unary = std::array<AdaptiveBit, kMostBits>;

  /// Class and sign of a correction.
  struct Known {
    uint8_t bits = 0;
    int8_t sign = 0;

    Known() = default;
    explicit Known(int32_t correction)
        : bits(static_cast<uint8_t>(std::bit_width(correction < 0
                                                       ? 0u - static_cast<uint32_t>(correction)
                                                       : static_cast<uint32_t>(correction)))),
          sign(static_cast<int8_t>((correction > 0) - (correction < 0))) {}
  };

  /// The neighbours before a sample.
  struct Before {
    Known west, north, north_west, north_east;

    int classes() const {
      const int sum = 2 * (west.bits + north.bits) + north_west.bits + north_east.bits;
      return sum < kQuiet ? sum : std::min(6 + (sum - 6) / 12, kNeighbour - 1);
    }
    /// The signs of the neighbours as one number from -40 to 40; reversing all signs negates it.
    int signs() const {
      return 27 * west.sign + 9 * north.sign + 3 * north_west.sign + north_east.sign;
    }
  };

  int32_t code(size_t sample, const Before& before) {
    const int classes = before.classes(), signs = before.signs();
    const auto pattern = static_cast<size_t>(std::abs(signs));
    const size_t hint = hints_.data[sample];
    assert(hint < kHints && pattern < kSigns && classes < kNeighbour);
    Unary& more = more_[hint * kNeighbour + static_cast<size_t>(classes)];
    AdaptiveBit& any =
        classes < kQuiet ? any_[hint * kQuiet + static_cast<size_t>(classes)][pattern] : more[0];
    if (!io_.more(any, sample, 0) || io_.stopped()) return 0;
    int bits = 1;
    while (bits < kMostBits && io_.more(more[static_cast<size_t>(bits)], sample, bits)) ++bits;
    const bool negative = io_.negative(sign_[pattern], sample, signs < 0);
    if (io_.stopped()) return 0;
    const uint32_t size = magnitude(sample, bits);
    return static_cast<int32_t>(negative ? 0u - size : size);
  }

  uint32_t magnitude(size_t sample, int bits) {
    uint32_t result = uint32_t{1} << (bits - 1);
    for (int position = bits - 2; position >= 0; --position) {
      const bool bit = position == bits - 2
                           ? io_.high(high_[static_cast<size_t>(bits) - 1], sample, position)
                           : io_.low(sample, position);
      result |= uint32_t{bit} << position;
    }
    return result;
  }

  const CorrectionHints hints_;
  Io& io_;
  std::vector<Signs> any_;  ///< whether there is a correction, in quiet places
  std::vector<Unary> more_;
  Signs sign_;
  Unary high_;  ///< the bit below the highest, by the class
};

}  // namespace tetrakis::inline corrections
