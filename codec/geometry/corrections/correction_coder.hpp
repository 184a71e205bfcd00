// SPDX-License-Identifier: Apache-2.0
// NumberCoder codes a number of a sample by questions, from the numbers nearby. All corrections of
// heights are such numbers. CorrectionCoder codes one a sample, row by row, and codeCorrections()
// those of a plane behind hints of the caller. Encoder and decoder differ only in their Io.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/coder/adaptive_bit.hpp"
#include "codec/geometry/corrections/error_forecast.hpp"
#include "codec/geometry/corrections/near_numbers.hpp"
#include "codec/geometry/corrections/number_models.hpp"

namespace tetrakis::inline corrections {

inline uint32_t magnitudeOf(int32_t correction) {
  const auto bits = static_cast<uint32_t>(correction);
  return correction < 0 ? 0u - bits : bits;
}

/// The number itself, or its negative modulo 2^32.
inline int32_t toSide(int32_t number, bool other) {
  return other ? static_cast<int32_t>(0u - static_cast<uint32_t>(number)) : number;
}

// A number is told by questions (number_models.hpp): is it the expected one, is it less, is it more
// than 1 off, more than 2, and so on. Where samples were copied, turned or rounded to tens, a
// neighbour has the very number that one of them asks about. If its number lies farther off than
// these questions go, whether it is the sample's is asked before them.

/// Io: DecisionEncoding or DecisionDecoding (bitstream/coder/).
template <class Io>
class NumberCoder {
 public:
  explicit NumberCoder(Io& io) : io_(io) {}

  /// The correction: how far the number of the sample lies from the expected one, from which `near`
  /// counts. known: the correction, or any number in decoders. Where io has stopped the result
  /// means nothing.
  int32_t code(const NearNumbers& near, NumberSize size, int32_t known) {
    const bool expected = near.expectedEverywhere();
    if (expected && !io_.decide(models_.askExpected(size), known != 0)) return 0;
    models_.look(near, size);
    if (!expected) {
      if (const std::optional<int32_t> far = codeFar(near, known)) return *far;
      if (!decide(Question::any(), known != 0)) return 0;
    }
    const bool negative = decide(Question::sign(), known < 0);
    const uint32_t magnitude = codeMagnitude(negative, magnitudeOf(known));
    return toSide(static_cast<int32_t>(magnitude), negative);
  }

 private:
  /// The correction, if it leads to the number of a neighbour that lies beyond the questions asked
  /// one after the other.
  std::optional<int32_t> codeFar(const NearNumbers& near, int32_t known) {
    const std::array<int64_t, NumberModels::kFar> numbers = {near.west, near.north,
                                                             near.north_east};
    for (size_t which = 0; which < numbers.size(); ++which) {
      const int64_t number = numbers[which];
      const auto end = numbers.begin() + static_cast<ptrdiff_t>(which);
      if (std::abs(number) <= Question::kOneByOne || std::find(numbers.begin(), end, number) != end)
        continue;
      const auto correction = static_cast<int32_t>(static_cast<uint32_t>(number));
      if (decide(models_.askFar(which, number), known == correction)) return correction;
    }
    return {};
  }

  uint32_t codeMagnitude(bool negative, uint32_t known) {
    for (int32_t size = 1; size < Question::kOneByOne; ++size) {
      const auto magnitude = static_cast<uint32_t>(size);
      if (!decide(Question::more(size, negative), known > magnitude)) return magnitude;
    }
    const uint32_t known_rest = known - (Question::kOneByOne - 1);
    const int known_bits = std::bit_width(known_rest);
    int bits = 1;
    while (bits < kMostBits && decide(Question::beyond(bits, negative), known_bits > bits)) ++bits;
    uint32_t rest = 1;
    for (int position = bits - 2; position >= 0; --position) {
      const bool bit = (known_rest >> position) & 1;
      rest =
          2 * rest + (position == bits - 2 ? io_.decide(high_[static_cast<size_t>(bits) - 1], bit)
                                           : io_.even(bit));
    }
    return rest + (Question::kOneByOne - 1);
  }

  bool decide(const Question& question, bool known) { return decide(models_.ask(question), known); }
  template <size_t kModels>
  bool decide(Mixture<kModels> mixture, bool known) {
    const bool answer = io_.decideOf(mixture.zero(), known);
    mixture.learn(answer);
    return answer;
  }

  static constexpr int kMostBits = 32;

  Io& io_;
  NumberModels models_;
  std::array<AdaptiveBit, kMostBits> high_;  ///< the second digit of a rest, by its bits
};

// Corrections that are numbers by themselves, mostly 0, turn decoded heights into heights within a
// bound (after SPERR's outliers: S. Li, P. Lindstrom, J. Clyne 2023, but quantised to twice the
// bound) or into the very samples. Their sizes and signs follow those of their neighbours, because
// the errors of a cut oscillate from sample to sample.

/// Corrections of samples, each expected to be 0.
template <class Io>
class CorrectionCoder {
 public:
  CorrectionCoder(uint32_t width, Io& io) : rows_(width), coder_(io) {}

  /// Begins a row, whose samples have no correction unless one is coded.
  void nextRow() { rows_.nextRow(); }

  /// The correction of the sample in column x, right of the coded ones. hint: of
  /// NumberSize::kPlaces. known: the correction itself, or any number in decoders. Where io has
  /// stopped the result means nothing.
  int32_t code(uint32_t x, size_t hint, int32_t known) {
    const NearNumbers near = rows_.near(x, 0, false);
    const auto size = [](int64_t number) { return static_cast<uint64_t>(std::abs(number)); };
    const uint64_t nearby =
        2 * (size(near.west) + size(near.north)) + size(near.north_west) + size(near.north_east);
    const size_t level = std::min(levelOf(nearby), NumberSize::kLevels - 1);
    const int32_t correction = coder_.code(near, {level, hint}, known);
    rows_.put(x, correction);
    return correction;
  }

 private:
  NumberRows rows_;
  NumberCoder<Io> coder_;
};

// codeCorrections() walks over the corrections of a plane for both sides: row by row, one
// correction for each sample that exists, with a hint of the caller for each.

/// The knowledge of both sides about the samples: a hint for each, below NumberSize::kPlaces.
/// Samples that do not exist have no correction.
using CorrectionHints = PlaneView<const uint8_t>;

/// Codes all corrections. Io: as of NumberCoder. known(sample): the correction, or any number in
/// decoders. take(first, row): takes the corrections row by row, up to the first undecided one.
template <class Io, class KnownCorrection, class TakeRow>
void codeCorrections(const CorrectionHints& hints, Io& io, const KnownCorrection& known,
                     const TakeRow& take) {
  CorrectionCoder<Io> coder(hints.width, io);
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
