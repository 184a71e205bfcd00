// SPDX-License-Identifier: Apache-2.0
// Reference decoder: binary range decoder with the tail rule, and adaptive decisions
// (docs/FORMAT.md, section 4).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

namespace tetrakis::reference {

class RangeDecoder {
 public:
  explicit RangeDecoder(std::span<const uint8_t> codeword) : codeword_(codeword) {
    for (int i = 0; i < 4; ++i) shiftIn();
    may_be_beyond_ = code_ + slack_ == 0xFFFFFFFFu;
  }

  /// `zero` is P(0) in units of 2^-16. Nothing: the missing bytes decide, the track ends here.
  std::optional<int> decode(uint32_t zero) {
    if (may_be_beyond_) return std::nullopt;
    const auto bound = static_cast<uint32_t>((uint64_t{range_} * zero) >> 16);
    if (code_ < bound && bound <= uint64_t{code_} + slack_) return std::nullopt;
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
  bool may_be_beyond_ = false;  ///< all of the first four bytes that are there are FF
};

/// FORMAT 4, "Adaptive decision".
class Model {
 public:
  Model() = default;
  /// FORMAT 5, "Models": trained ones.
  explicit Model(int start) : zero_(256 * start), seen_(20) {}

  std::optional<int> decode(RangeDecoder& decoder) {
    const std::optional<int> bit =
        decoder.decode(static_cast<uint32_t>(std::clamp(zero_, 4, 65532)));
    if (bit) learn(*bit);
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

}  // namespace tetrakis::reference
