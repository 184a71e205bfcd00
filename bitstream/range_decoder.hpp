// SPDX-License-Identifier: Apache-2.0
// Binary range decoder, mirror of range_encoder.hpp, with the tail rule: where bytes are missing, a
// decision counts only if reading the missing tail as all zeros and as all ones agrees on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bitstream/adaptive_bit.hpp"

namespace tetrakis {

/// Safe on any input; reads at most bytes.size() bytes; stops for good at the first undecided bit.
class RangeDecoder {
 public:
  explicit RangeDecoder(std::span<const uint8_t> bytes)
      : next_(bytes.data()), end_(next_ + bytes.size()) {
    for (int i = 0; i < 4; ++i) shiftIn();
  }

  /// Decodes one decision and updates the model. After exhausted() the result is meaningless and
  /// nothing changes any more.
  bool decode(AdaptiveBit& model) {
    const bool bit = split(model.zero());
    if (!exhausted_) model.update(bit);
    return bit;
  }

  /// More bytes of the codeword have come: `bytes` is a longer view of the same memory. As if they
  /// had been there from the start; not after exhausted().
  void grow(std::span<const uint8_t> bytes) {
    end_ = bytes.data() + bytes.size();
    for (; missing_ > 0 && next_ != end_; --missing_) {
      const uint32_t shift = 8 * (missing_ - 1);
      if (shift < 32) code_ += uint32_t{*next_} << shift;
      ++next_;
    }
    slack_ = missing_ > 3 ? 0xffffffff : (uint32_t{1} << (8 * missing_)) - 1;
  }

  bool decodeEven() { return split(1u << (AdaptiveBit::kPrecision - 1)); }

  /// The available bytes do not decide the decision asked for last.
  bool exhausted() const { return exhausted_; }

 private:
  bool split(uint32_t zero) {
    const uint32_t bound =
        static_cast<uint32_t>((uint64_t{range_} * zero) >> AdaptiveBit::kPrecision);
    const bool bit = code_ >= bound;
    if (slack_ != 0 && (exhausted_ || (!bit && uint64_t{code_} + slack_ >= bound))) {
      exhausted_ = true;
      return false;
    }
    if (bit) {
      code_ -= bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    while (range_ < kRenormalise) {
      range_ <<= 8;
      shiftIn();
    }
    return bit;
  }

  void shiftIn() {
    code_ <<= 8;
    slack_ <<= 8;
    if (next_ != end_) {
      code_ |= *next_++;
    } else {
      slack_ |= 0xff;
      ++missing_;
    }
  }

  static constexpr uint32_t kRenormalise = 1u << 24;
  const uint8_t* next_;
  const uint8_t* end_;
  uint32_t code_ = 0;  ///< offset inside the interval, missing bytes read as zeros
  uint32_t range_ = 0xffffffff;
  uint32_t slack_ = 0;    ///< what missing bytes could add to code_ if they were all ones
  uint32_t missing_ = 0;  ///< bytes read behind the end
  bool exhausted_ = false;
};

}  // namespace tetrakis
