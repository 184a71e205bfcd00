// SPDX-License-Identifier: Apache-2.0
// CorrectionWriter is the encoder's side of a correction (correction_coder.hpp).
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "bitstream/coder/range_encoder.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"

namespace tetrakis::inline corrections {

class CorrectionWriter {
 public:
  bool more(AdaptiveBit& model, int32_t known, int depth) {
    const bool bit = static_cast<int>(std::bit_width(magnitudeOf(known))) > depth;
    encoder_.encode(model, bit);
    return bit;
  }
  bool negative(AdaptiveBit& model, int32_t known, bool flip) {
    const bool negative = known < 0;
    encoder_.encode(model, negative != flip);
    return negative;
  }
  bool high(AdaptiveBit& model, int32_t known, int position) {
    const bool bit = (magnitudeOf(known) >> position) & 1;
    encoder_.encode(model, bit);
    return bit;
  }
  bool low(int32_t known, int position) {
    const bool bit = (magnitudeOf(known) >> position) & 1;
    encoder_.encodeEven(bit);
    return bit;
  }
  static constexpr bool stopped() { return false; }

  /// The codeword, after which nothing is written.
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  RangeEncoder encoder_;
};

}  // namespace tetrakis::inline corrections
