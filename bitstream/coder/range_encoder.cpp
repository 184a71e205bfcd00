// SPDX-License-Identifier: Apache-2.0
#include "bitstream/coder/range_encoder.hpp"

#include <utility>

namespace tetrakis::inline coder {

void RangeEncoder::shiftLow() {
  const bool carry = (low_ >> 32) != 0;
  const auto top = static_cast<uint8_t>(low_ >> 24);
  if (carry || top != 0xff) {
    if (started_) bytes_.push_back(static_cast<uint8_t>(cache_ + carry));
    for (; pending_ != 0; --pending_) bytes_.push_back(static_cast<uint8_t>(0xff + carry));
    cache_ = top;
    started_ = true;
  } else {
    ++pending_;
  }
  low_ = (low_ & 0x00ffffff) << 8;
  ++shifts_;
}

std::vector<uint8_t> RangeEncoder::finish() {
  // The shortest k-byte value whose whole cell [v, v + 2^(32-8k)) lies in [low, low + range).
  // range >= 2^24, so k = 2 always fits.
  int keep = 2;
  for (int k = 0; k < 2; ++k) {
    const uint64_t cell = uint64_t{1} << (32 - 8 * k);
    const uint64_t value = (low_ + cell - 1) & ~(cell - 1);
    if (value + cell <= low_ + range_) {
      keep = k;
      break;
    }
  }
  const uint64_t cell = uint64_t{1} << (32 - 8 * keep);
  low_ = (low_ + cell - 1) & ~(cell - 1);
  for (int k = 0; k < keep; ++k) shiftLow();
  // One more shift writes the byte held back in cache_ (and applies a last carry to it).
  low_ &= uint64_t{1} << 32;
  shiftLow();
  bytes_.shrink_to_fit();
  return std::move(bytes_);
}

}  // namespace tetrakis::inline coder
