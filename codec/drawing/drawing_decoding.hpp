// SPDX-License-Identifier: Apache-2.0
// DrawingDecoding is the decoder's side of drawing_pass.hpp: it answers each decision of the pass
// from a codeword.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bitstream/coder/range_decoder.hpp"
#include "codec/drawing/drawing_index.hpp"

namespace tetrakis::inline drawing {

template <class Value>
class DrawingDecoding {
 public:
  explicit DrawingDecoding(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  DrawnIndex target(size_t) const { return kNoIndex; }
  const Value& value(size_t) const { return unknown_; }
  bool bit(AdaptiveBit& model, bool) { return decoder_.decode(model); }
  bool bitOf(uint32_t zero, bool) { return decoder_.decodeOf(zero); }
  bool evenBit(bool) { return decoder_.decodeEven(); }
  bool stopped() const { return decoder_.exhausted(); }

 private:
  RangeDecoder decoder_;
  Value unknown_{};
};

}  // namespace tetrakis::inline drawing
