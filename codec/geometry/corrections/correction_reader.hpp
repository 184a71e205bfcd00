// SPDX-License-Identifier: Apache-2.0
// CorrectionReader is the decoder's side of a correction (correction_coder.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/coder/range_decoder.hpp"

namespace tetrakis::inline corrections {

/// Decoder: a RangeDecoder, or a class with the same functions.
template <class Decoder = RangeDecoder>
class CorrectionReader {
 public:
  /// codeword: any prefix of a codeword of corrections; outlives the reader.
  explicit CorrectionReader(std::span<const uint8_t> codeword) : decoder_(codeword) {}

  bool more(AdaptiveBit& model, int32_t, int) { return decoder_.decode(model); }
  bool negative(AdaptiveBit& model, int32_t, bool flip) { return decoder_.decode(model) != flip; }
  bool high(AdaptiveBit& model, int32_t, int) { return decoder_.decode(model); }
  bool low(int32_t, int) { return decoder_.decodeEven(); }
  bool stopped() const { return decoder_.exhausted(); }
  const Decoder& decoder() const { return decoder_; }

 private:
  Decoder decoder_;
};

}  // namespace tetrakis::inline corrections
