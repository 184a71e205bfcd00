// SPDX-License-Identifier: Apache-2.0
// DecisionEncoding is the encoder's side of passes whose decisions are a codeword of their own
// (codec/geometry/flat/flat_pass.hpp, codec/wavelet/priority_pass.hpp): their `Io`. The decoder's
// side is decision_decoding.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/coder/range_encoder.hpp"

namespace tetrakis::inline coder {

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
