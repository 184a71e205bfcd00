// SPDX-License-Identifier: Apache-2.0
// Reference decoder: binary range decoder with the tail rule, and adaptive decisions
// (docs/FORMAT.md, section 4).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tetrakis::reference {

/// Thrown: a decision does not count, and no later one of its codeword.
struct Undecided {};

class RangeDecoder {
 public:
  explicit RangeDecoder(std::span<const uint8_t> codeword) : codeword_(codeword) {
    for (int i = 0; i < 4; ++i) shiftIn();
    may_be_beyond_ = code_ + slack_ == 0xFFFFFFFFu;
  }

  /// `zero` is P(0) in units of 2^-16.
  int decode(uint32_t zero) {
    const auto bound = static_cast<uint32_t>((uint64_t{range_} * zero) >> 16);
    may_be_beyond_ |= code_ < bound && bound <= uint64_t{code_} + slack_;
    if (may_be_beyond_) throw Undecided();
    const int bit = code_ >= bound;
    if (bit) {
      code_ -= bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    while (range_ < 1u << 24) {
      range_ <<= 8;
      shiftIn();
    }
    return bit;
  }
  int even() { return decode(1 << 15); }

 private:
  void shiftIn() {
    const bool missing = next_ >= codeword_.size();
    code_ = code_ << 8 | (missing ? 0u : codeword_[next_]);
    slack_ = slack_ << 8 | (missing ? 255u : 0u);
    ++next_;
  }

  std::span<const uint8_t> codeword_;
  size_t next_ = 0;
  uint32_t code_ = 0, slack_ = 0, range_ = 0xFFFFFFFFu;
  bool may_be_beyond_ = false;  ///< all of the first four bytes that are there are FF, or ended
};

/// FORMAT 4, "Adaptive decision".
class Model {
 public:
  Model() = default;
  /// FORMAT 5, "Models": trained ones.
  explicit Model(int start) : zero_(256 * start), seen_(20) {}

  int decode(RangeDecoder& decoder) {
    const int bit = decoder.decode(static_cast<uint32_t>(zero()));
    learn(bit);
    return bit;
  }

  void learn(int bit) {
    const int target = bit ? 0 : 0xFFFF;
    const int share = (32768 + (seen_ + 2) / 2) / (seen_ + 2);
    zero_ += ((target - zero_) * share + (target & 0x7FFF)) >> 15;
    seen_ = std::min(seen_ + 1, 255);
  }

  int seen() const { return seen_; }
  int zero() const { return std::clamp(zero_, 4, 65532); }

 private:
  int zero_ = 0x8000, seen_ = 0;
};

/// FORMAT 4, "Numbers". ask(i): decision i.
template <class Ask>
int ones(int most, const Ask& ask) {
  int count = 0;
  while (count < most && ask(count)) ++count;
  return count;
}
/// A number of so many digits, at least one. ask(digits, number): after so many digits, which make
/// that number.
template <class Ask>
uint32_t digits(int count, const Ask& ask) {
  uint32_t number = 1;
  for (int i = 1; i < count; ++i) number = 2 * number + static_cast<uint32_t>(ask(i, number));
  return number;
}
inline uint32_t digits(RangeDecoder& decoder, int count, std::span<Model> high) {
  return digits(count, [&](int i, uint32_t) {
    return i == 1 ? high[static_cast<size_t>(count)].decode(decoder) : decoder.even();
  });
}
/// Modulo 2^32.
inline uint32_t signedNumber(RangeDecoder& decoder, std::span<Model> models) {
  const auto more = [&](int i) { return models[static_cast<size_t>(i)].decode(decoder); };
  const int count = ones(static_cast<int>(models.size()), more);
  if (count == 0) return 0;
  const uint32_t number = digits(count, [&](int, uint32_t) { return decoder.even(); });
  return decoder.even() ? 0 - number : number;
}

}  // namespace tetrakis::reference
