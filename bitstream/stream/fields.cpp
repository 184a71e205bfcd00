// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/fields.hpp"

namespace tetrakis::inline stream {

void FieldReader::fail(const std::string& name, const std::string& why) {
  if (!ok()) return;
  status_ = Status(TKS_CORRUPT, "Corrupt stream: " + name + " at byte " +
                                    std::to_string(origin_ + at_) + " " + why + ".");
}

bool FieldReader::isWithin(const char* name, uint64_t raw, uint64_t low, uint64_t high) {
  if (ok() && (raw < low || raw > high)) {
    fail(name, "is " + std::to_string(raw) + ", allowed are " + std::to_string(low) + " to " +
                   std::to_string(high));
  }
  return ok();
}

uint8_t FieldReader::next() {
  if (!ok()) return 0;
  if (at_ == bytes_.size()) {
    starved_ = true;
    fail("structure", "ends early");
    return 0;
  }
  return bytes_[at_++];
}

uint64_t FieldReader::take() {
  uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const uint8_t byte = next();
    if (!ok()) return 0;
    if (shift == 63 && byte > 1) break;
    value |= uint64_t{byte & 0x7fu} << shift;
    if (byte < 0x80) return value;
  }
  fail("number", "exceeds 64 bits");
  return 0;
}

}  // namespace tetrakis::inline stream
