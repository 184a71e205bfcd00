// SPDX-License-Identifier: Apache-2.0
// DecisionDecoding is the decoder's side of passes whose decisions are a codeword of their own
// (codec/geometry/flat/flat_pass.hpp, codec/wavelet/priority_pass.hpp): their `Io`. The encoder's
// side is decision_encoding.hpp.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/coder/range_decoder.hpp"

namespace tetrakis::inline coder {

/// Decoder: a RangeDecoder, or what stands in its place.
template <class Decoder = RangeDecoder>
class DecisionDecoding {
 public:
  explicit DecisionDecoding(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  bool decide(AdaptiveBit& model, bool) { return decoder_.decode(model); }
  bool decideOf(uint32_t zero, bool) { return decoder_.decodeOf(zero); }
  bool even(bool) { return decoder_.decodeEven(); }
  uint32_t run(AdaptiveBit& model, bool answer, uint32_t most) {
    return decoder_.decodeRun(model, answer, most);
  }
  bool stopped() const { return decoder_.exhausted(); }
  const Decoder& decoder() const { return decoder_; }

 private:
  Decoder decoder_;
};

}  // namespace tetrakis::inline coder
