// SPDX-License-Identifier: Apache-2.0
// RangeEncoder turns decisions into bytes by binary range coding (G. N. N. Martin 1979; carries are
// handled as in I. Pavlov's LZMA). One codeword holds a whole track; packets are cut out of it at
// any byte.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "bitstream/coder/adaptive_bit.hpp"

namespace tetrakis::inline coder {

class RangeEncoder {
 public:
  /// Encodes one decision with an adaptive model and updates the model.
  void encode(AdaptiveBit& model, bool bit) {
    split(model.zero(), bit);
    model.update(bit);
  }

  /// Encodes one decision. zero: P(bit = 0) in units of 2^-16, neither 0 nor 1.
  void encodeOf(uint32_t zero, bool bit) { split(zero, bit); }

  /// Encodes one decision of even odds.
  void encodeEven(bool bit) { split(1u << (AdaptiveBit::kPrecision - 1), bit); }

  /// Every decision so far is decided by the first decidedBytes() bytes of the finished codeword,
  /// whatever follows them: the decoder's window then lies inside the current interval.
  uint64_t decidedBytes() const { return shifts_ + 4; }

  /// Ends the codeword with the fewest bytes that decide it under any continuation.
  std::vector<uint8_t> finish();

 private:
  void split(uint32_t zero, bool bit) {
    assert(zero > 0 && zero < 1u << AdaptiveBit::kPrecision);
    assert(range_ >= kRenormalise);
    const uint32_t bound =
        static_cast<uint32_t>((uint64_t{range_} * zero) >> AdaptiveBit::kPrecision);
    if (bit) {
      low_ += bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    assert(range_ > 0);
    while (range_ < kRenormalise) {
      range_ <<= 8;
      shiftLow();
    }
  }
  void shiftLow();

  static constexpr uint32_t kRenormalise = 1u << 24;
  uint64_t low_ = 0;  ///< low end of the interval; bit 32 is a carry into the bytes before
  uint32_t range_ = 0xffffffff;
  uint64_t shifts_ = 0;   ///< renormalisations so far
  uint8_t cache_ = 0;     ///< last byte not yet written: a carry may still change it
  uint64_t pending_ = 0;  ///< bytes of 0xff behind cache_, waiting for a carry
  bool started_ = false;  ///< cache_ holds a byte
  std::vector<uint8_t> bytes_;
};

// DecisionEncoding is the encoder's side of passes whose decisions are a codeword of their own
// (codec/geometry/flat/flat_pass.hpp, codec/wavelet/priority_map.hpp): their `Io`. The decoder's
// side is range_decoder.hpp.

class DecisionEncoding {
 public:
  bool decide(AdaptiveBit& model, bool answer) {
    encoder_.encode(model, answer);
    return answer;
  }
  /// zero: the odds that the answer is 0, in units of 2^-16.
  bool decideOf(uint32_t zero, bool answer) {
    encoder_.encodeOf(zero, answer);
    return answer;
  }
  bool even(bool answer) {
    encoder_.encodeEven(answer);
    return answer;
  }
  /// Each decision is taken by itself.
  uint32_t run(AdaptiveBit&, bool, uint32_t) { return 0; }
  bool stopped() const { return false; }
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  RangeEncoder encoder_;
};

}  // namespace tetrakis::inline coder
