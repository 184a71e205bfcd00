// SPDX-License-Identifier: Apache-2.0
// A GrowingDecoder decodes a whole codeword and knows how many of its bytes decide what it has
// decoded: a decision that the bytes so far leave open gets the next byte. So encoders find out
// what every prefix shows by decoding once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bitstream/coder/range_decoder.hpp"

namespace tetrakis::inline coder {

/// Has the functions of a RangeDecoder that passes call.
class GrowingDecoder {
 public:
  /// codeword: all of it, as an encoder wrote it; outlives the decoder.
  explicit GrowingDecoder(std::span<const uint8_t> codeword)
      : codeword_(codeword), bytes_(leastBytes(codeword)), decoder_(codeword.first(bytes_)) {}

  bool decode(AdaptiveBit& model) {
    growFor(model.zero());
    return decoder_.decode(model);
  }
  bool decodeOf(uint32_t zero) {
    growFor(zero);
    return decoder_.decodeOf(zero);
  }
  bool decodeEven() {
    growFor(1u << (AdaptiveBit::kPrecision - 1));
    return decoder_.decodeEven();
  }
  bool exhausted() const { return decoder_.exhausted(); }

  /// How many bytes decide all decisions so far.
  uint64_t bytes() const { return bytes_; }

 private:
  /// How many bytes it takes until any decision counts: those of FF alone decide nothing.
  static size_t leastBytes(std::span<const uint8_t> codeword) {
    size_t bytes = 0;
    while (bytes < codeword.size() && RangeDecoder(codeword.first(bytes)).exhausted()) ++bytes;
    return bytes;
  }
  void growFor(uint32_t zero) {
    while (bytes_ < codeword_.size() && !decoder_.decides(zero)) {
      decoder_.grow(codeword_.first(bytes_ + 1), bytes_);
      ++bytes_;
    }
  }

  std::span<const uint8_t> codeword_;
  size_t bytes_;  ///< that the decoder has
  RangeDecoder decoder_;
};

}  // namespace tetrakis::inline coder
