// SPDX-License-Identifier: Apache-2.0
// ValueTablePass codes a table of the values that samples have, where their type could hold many
// more: the first word, then the gap from each value to the next. Gaps of such tables come back
// again and again (3, 3, 4, 3, 3, 4 where metres became feet), so the eight latest different ones
// are kept, the last one first (J. L. Bentley et al., "A locally adaptive data compression scheme",
// 1986). A gap is one of these, named by its place; or it is new: its number of bits in unary, then
// the bits below the highest.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "bitstream/coder/adaptive_bit.hpp"

namespace tetrakis::inline coder {

/// Io is the encoder's or the decoder's side of a decision, of which the encoder knows the answer:
///   bool decide(AdaptiveBit&, bool answer)   bool even(bool answer)   at even odds
///   bool stopped()                           the last decision did not count
template <class Io>
class ValueTablePass {
 public:
  /// bits: of a word.
  ValueTablePass(Io& io, int bits) : io_(io), bits_(bits) {
    std::iota(recent_.begin(), recent_.end(), 1u);
  }

  /// words: of the encoder the table, of the decoder as many zeros, which it fills. Words behind
  /// the first decision that does not count mean nothing. Further tables learn from earlier ones.
  void run(std::vector<uint32_t>& words) {
    uint32_t before = 0;
    for (size_t i = 0; i < words.size() && !io_.stopped(); ++i) {
      const uint32_t gap = words[i] - before;
      before += i == 0 ? plain(gap, bits_) : next(gap);
      words[i] = before;
    }
  }

 private:
  static constexpr int kMostBits = 32;  ///< of a gap
  static constexpr size_t kRecent = 8;
  static constexpr int kModelledBits = 3;  ///< below the highest

  uint32_t next(uint32_t gap) {
    const size_t known = place(gap);
    const uint32_t value = known < kRecent ? recent_[known] : fresh(gap);
    const auto end = recent_.begin() + static_cast<ptrdiff_t>(std::min(known, kRecent - 1));
    std::rotate(recent_.begin(), end, end + 1);
    recent_.front() = value;
    last_place_ = known;
    return value;
  }

  /// kRecent: it is none of them.
  size_t place(uint32_t gap) {
    for (size_t i = 0; i < kRecent; ++i) {
      if (io_.decide(hit_[last_place_][i], recent_[i] == gap)) return i;
      if (io_.stopped()) return kRecent;
    }
    return kRecent;
  }

  uint32_t fresh(uint32_t gap) {
    const int wanted = static_cast<int>(std::bit_width(gap));
    int bits = 1;
    while (bits < kMostBits && io_.decide(more_[last_bits_][bits - 1], wanted > bits)) ++bits;
    last_bits_ = static_cast<size_t>(bits);
    uint32_t value = 1;
    for (int position = bits - 2; position >= 0; --position) {
      const bool answer = (gap >> position) & 1;
      const bool modelled = value < 1u << kModelledBits;
      const bool bit = modelled ? io_.decide(high_[last_bits_][value], answer) : io_.even(answer);
      value = value << 1 | uint32_t{bit};
    }
    return value;
  }

  uint32_t plain(uint32_t word, int bits) {
    uint32_t value = 0;
    for (int position = bits - 1; position >= 0; --position)
      value = value << 1 | uint32_t{io_.even((word >> position) & 1)};
    return value;
  }

  Io& io_;
  int bits_;
  std::array<uint32_t, kRecent> recent_{};
  size_t last_place_ = 0, last_bits_ = 0;
  std::array<std::array<AdaptiveBit, kRecent>, kRecent + 1> hit_;
  std::array<std::array<AdaptiveBit, kMostBits>, kMostBits + 1> more_;
  std::array<std::array<AdaptiveBit, 1u << kModelledBits>, kMostBits + 1> high_;
};

}  // namespace tetrakis::inline coder
