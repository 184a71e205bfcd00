// SPDX-License-Identifier: Apache-2.0
// AdaptiveBit is a model that predicts one kind of binary decision from those before. It is a
// running mean that follows the 1/n rule at first and becomes an exponential mean of about 2^8
// decisions (after M. Mahoney's PAQ state counters).
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace tetrakis::inline coder {

/// Share of the n-th decision in the mean of an AdaptiveBit: 1 / (n + 2), in units of 2^-15.
inline constexpr auto kDecisionShare = [] {
  std::array<int32_t, 256> table{};
  for (int32_t n = 0; n < 256; ++n) table[static_cast<size_t>(n)] = (32768 + (n + 2) / 2) / (n + 2);
  return table;
}();

class AdaptiveBit {
 public:
  static constexpr int kPrecision = 16;    ///< probabilities are multiples of 2^-16
  static constexpr uint32_t kLimit = 255;  ///< decisions after which the mean forgets
  static constexpr uint16_t kTrust = 20;
  static constexpr uint32_t kFloor = 4;  ///< no decision is more certain than 1 - 4/65536

  AdaptiveBit() = default;
  /// zero: initial P(bit = 0) in 1/256, at most 254, trusted like kTrust decisions.
  explicit AdaptiveBit(uint8_t zero) : zero_(static_cast<uint16_t>(zero << 8)), seen_(kTrust) {}

  /// P(bit = 0) in units of 2^-16.
  uint32_t zero() const { return std::clamp<uint32_t>(zero_, kFloor, 65536 - kFloor); }

  /// It has seen two decisions, or was trained.
  bool experienced() const { return seen_ >= 2; }

  /// No such decision changes the model any more.
  bool isSettledOn(bool bit) const { return seen_ == kLimit && zero_ == (bit ? 0 : 0xffff); }

  void update(bool bit) {
    assert(seen_ < kDecisionShare.size());
    // Rounded towards the target: else the mean of zeros would stop 2^-8 before it, and each void
    // sample of a large plane would take ten times as much.
    const int32_t target = bit ? 0 : 0xffff;
    const int32_t step = (target - zero_) * kDecisionShare[seen_] + (target & 0x7fff);
    zero_ = static_cast<uint16_t>(zero_ + (step >> 15));
    seen_ = static_cast<uint16_t>(seen_ + (seen_ < kLimit));
  }

 private:
  uint16_t zero_ = 0x8000;
  uint16_t seen_ = 0;  ///< decisions so far, up to kLimit
};

// mostDecisions() bounds the number of decisions that bytes can pay for. So the time for a codeword
// is bounded by its bytes, however many samples its plane has.

/// No more decisions count than these of a codeword of so many bytes. Each leaves at most
/// 1 - kFloor / 2^16 of the range and 1, which is less than 2^-24 of it: at least 8.79e-5 bits.
constexpr uint64_t mostDecisions(size_t bytes) {
  constexpr uint64_t kOfByte = 91'100;  // 8 bits / 8.79e-5
  static_assert(AdaptiveBit::kFloor == 4 && AdaptiveBit::kPrecision == 16);
  return kOfByte * (bytes + 1);
}

}  // namespace tetrakis::inline coder
