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

void FieldReader::expectEnd() {
  if (at_ < bytes_.size()) fail("part", "has bytes behind its fields");
}

uint64_t FieldReader::nextKind() {
  const size_t before = at_;
  const uint64_t kind = take();
  at_ = before;
  return kind;
}

FieldReader FieldReader::openPart() {
  const uint64_t kind = take();
  if (ok() && last_kind_ && kind < *last_kind_) fail("part", "stands behind one of a higher kind");
  last_kind_ = kind;
  const uint64_t size = take();
  if (ok() && size > bytes_.size() - at_) fail("part", "reaches past the end of its structure");
  if (!ok()) return FieldReader({});
  FieldReader body(bytes_.subspan(at_, size), origin_ + at_);
  at_ += size;
  return body;
}

void FieldReader::skipPartsBefore(std::optional<uint64_t> kind) {
  while (ok() && at_ < bytes_.size() && (!kind || nextKind() < *kind)) {
    const std::optional<uint64_t> before = last_kind_;
    const size_t begin = at_;
    openPart();
    if (last_kind_ == before) fail("part", "stands twice");
    if (ok() && *last_kind_ < kMaySkip) {
      status_ =
          Status(TKS_UNSUPPORTED, "The stream has a part of kind " + std::to_string(*last_kind_) +
                                      " that this decoder does not know.");
    }
    const auto part = bytes_.subspan(begin, at_ - begin);
    skipped_.append(part.begin(), part.end());
  }
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
