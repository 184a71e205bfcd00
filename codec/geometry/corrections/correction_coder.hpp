// SPDX-License-Identifier: Apache-2.0
// CorrectionCoder codes one correction and codeCorrections() all corrections of a plane, from hints
// of the caller, once for both sides: encoder and decoder differ only in their Io.
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

// A correction is a small integer, mostly 0. Corrections turn decoded heights into heights within a
// bound (after SPERR's outliers: S. Li, P. Lindstrom, J. Clyne 2023, but quantised to twice the
// bound) or into the very samples. They are coded row by row.
//
// A correction of magnitude m has the class bits(m). The coder decides whether the class exceeds 0,
// then 1, and so on; then it codes the sign, and the bits below the highest one, of which all but
// the first are at even odds. The contexts are a hint of the caller, the classes of the neighbours
// before (2 W + 2 N + NW + NE), and their signs, because the errors of a cut oscillate from sample
// to sample. Against signs at even odds that saves 2 to 15 % of the corrections.

inline uint32_t magnitudeOf(int32_t correction) {
  const auto bits = static_cast<uint32_t>(correction);
  return correction < 0 ? 0u - bits : bits;
}

/// The number itself, or its negative modulo 2^32.
inline int32_t toSide(int32_t number, bool other) {
  return other ? static_cast<int32_t>(0u - static_cast<uint32_t>(number)) : number;
}

/// Binary digits of magnitudes below the highest one: the first by the class, others at even odds.
class CorrectionDigits {
 public:
  /// The magnitude of `bits` bits. Io, known: of CorrectionCoder.
  template <class Io>
  uint32_t code(Io& io, int32_t known, int bits) {
    uint32_t result = uint32_t{1} << (bits - 1);
    for (int position = bits - 2; position >= 0; --position) {
      const bool bit = position == bits - 2
                           ? io.high(high_[static_cast<size_t>(bits) - 1], known, position)
                           : io.low(known, position);
      result |= uint32_t{bit} << position;
    }
    return result;
  }

 private:
  std::array<AdaptiveBit, 32> high_;
};

/// Io is the encoder's or the decoder's side of a decision; only the encoder knows the correction:
///   bool more(AdaptiveBit&, int32_t known, int depth)       the class of it exceeds depth
///   bool negative(AdaptiveBit&, int32_t known, bool flip)   negative, xor flip
///   bool high(AdaptiveBit&, int32_t known, int position)    bit `position` of the magnitude
///   bool low(int32_t known, int position)                   the same at even odds
///   bool stopped()                                          the last decision did not count
template <class Io>
class CorrectionCoder {
 public:
  /// hints: the number of different hints.
  CorrectionCoder(uint32_t width, size_t hints, Io& io)
      : io_(io),
        above_(size_t{width} + 2),
        here_(above_),
        any_(hints * kQuiet),
        more_(hints * kNeighbour) {}

  /// Begins a row, whose samples have no correction unless one is coded.
  void nextRow() {
    std::swap(above_, here_);
    std::fill(here_.begin(), here_.end(), Known());
  }

  /// The correction of the sample in column x, right of the coded ones. known: the correction
  /// itself, or any number in decoders. Where io has stopped the result means nothing.
  int32_t code(uint32_t x, size_t hint, int32_t known) {
    const int32_t correction =
        code(hint, known, {here_[x], above_[x + 1], above_[x], above_[x + 2]});
    here_[x + 1] = Known(correction);
    return correction;
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
        : bits(static_cast<uint8_t>(std::bit_width(magnitudeOf(correction)))),
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

  int32_t code(size_t hint, int32_t known, const Before& before) {
    const int classes = before.classes(), signs = before.signs();
    const auto pattern = static_cast<size_t>(std::abs(signs));
    assert(hint < any_.size() / kQuiet && pattern < kSigns && classes < kNeighbour);
    Unary& more = more_[hint * kNeighbour + static_cast<size_t>(classes)];
    AdaptiveBit& any =
        classes < kQuiet ? any_[hint * kQuiet + static_cast<size_t>(classes)][pattern] : more[0];
    if (!io_.more(any, known, 0) || io_.stopped()) return 0;
    int bits = 1;
    while (bits < kMostBits && io_.more(more[static_cast<size_t>(bits)], known, bits)) ++bits;
    const bool negative = io_.negative(sign_[pattern], known, signs < 0);
    if (io_.stopped()) return 0;
    const uint32_t size = digits_.code(io_, known, bits);
    return static_cast<int32_t>(negative ? 0u - size : size);
  }

  Io& io_;
  std::vector<Known> above_, here_;  ///< the row before and this one, with a margin on both sides
  std::vector<Signs> any_;           ///< whether there is a correction, in quiet places
  std::vector<Unary> more_;
  Signs sign_;
  CorrectionDigits digits_;
};

// codeCorrections() walks over the corrections of a plane for both sides: row by row, one
// correction for each sample that exists, with a hint of the caller for each.

/// The knowledge of both sides about the samples: a hint for each, below kHints. Samples that do
/// not exist have no correction.
using CorrectionHints = PlaneView<const uint8_t>;
inline constexpr int kHints = 32;

/// Codes all corrections. Io: as of CorrectionCoder. known(sample): the correction, or any number
/// in decoders. take(first, row): takes the corrections row by row, up to the first undecided one.
template <class Io, class KnownCorrection, class TakeRow>
void codeCorrections(const CorrectionHints& hints, Io& io, const KnownCorrection& known,
                     const TakeRow& take) {
  CorrectionCoder<Io> coder(hints.width, kHints, io);
  std::vector<int32_t> row(hints.width);
  for (uint32_t y = 0; y < hints.height; ++y) {
    const size_t first = size_t{y} * hints.width;
    coder.nextRow();
    for (uint32_t x = 0; x < hints.width; ++x) {
      row[x] = 0;
      if (!hints.valid[first + x]) continue;
      row[x] = coder.code(x, hints.data[first + x], known(first + x));
      if (io.stopped()) return take(first, std::span<const int32_t>(row).first(x));
    }
    take(first, std::span<const int32_t>(row));
  }
}

}  // namespace tetrakis::inline corrections
