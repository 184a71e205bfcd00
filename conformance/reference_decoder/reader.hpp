// SPDX-License-Identifier: Apache-2.0
// Reference decoder: types of header fields (docs/FORMAT.md, section 2).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "conformance/reference_decoder.hpp"

namespace tetrakis::reference {

/// FORMAT 2: CRC-32, "polynomial EDB88320 reflected, initial and final xor FFFFFFFF".
inline uint32_t crc32(std::span<const uint8_t> bytes) {
  uint32_t crc = 0xFFFFFFFFu;
  for (const uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return ~crc;
}

/// Reads fields; after the first that is missing or out of range it returns zeros only.
class Reader {
 public:
  explicit Reader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  Outcome outcome() const { return outcome_; }
  std::span<const uint8_t> rest() const { return bytes_; }
  void fail(Outcome outcome) {
    if (outcome_ == Outcome::kDone) outcome_ = outcome;
  }

  /// `size` bytes, none if there are fewer.
  std::span<const uint8_t> take(uint64_t size) {
    if (size > bytes_.size()) fail(Outcome::kTruncated);
    if (outcome_ != Outcome::kDone) return {};
    const auto taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }
  /// FORMAT 2, Parts: whether the fields that are left have the values that they have "else".
  bool ends() const { return bytes_.empty() || outcome_ != Outcome::kDone; }
  uint8_t byte() {
    const auto taken = take(1);
    return taken.empty() ? uint8_t{0} : taken[0];
  }
  int u8(int low, int high) { return static_cast<int>(within(byte(), low, high)); }
  uint64_t littleEndian(int count) {
    uint64_t value = 0;
    for (int i = 0; i < count; ++i) value |= uint64_t{byte()} << (8 * i);
    return value;
  }
  double f64(bool infinite = false) {
    const int size = u8(0, 8);
    const uint64_t high = littleEndian(size);
    const auto value = std::bit_cast<double>(size == 0 ? 0 : high << (64 - 8 * size));
    if (std::isnan(value) || (std::isinf(value) && !infinite)) fail(Outcome::kCorrupt);
    return value;
  }

  /// FORMAT 2: "seven bits a byte, low bits first, bit 7 set while more follow, at most 64 bits".
  uint64_t varint(uint64_t low, uint64_t high) {
    uint64_t value = 0;
    for (int shift = 0; shift < 70; shift += 7) {
      const uint64_t next = byte();
      if (shift == 63 && next > 1) fail(Outcome::kCorrupt);
      value |= (next & 127) << shift;
      if (next < 128) break;
    }
    return within(value, low, high);
  }
  /// FORMAT 3: one whose last byte is 0 has needless bytes.
  uint64_t shortestVarint(uint64_t low, uint64_t high) {
    const std::span<const uint8_t> before = bytes_;
    const uint64_t value = varint(low, high);
    const size_t taken = before.size() - bytes_.size();
    if (outcome_ == Outcome::kDone && taken > 1 && before[taken - 1] == 0) fail(Outcome::kCorrupt);
    return value;
  }
  int zigzag(uint64_t largest) { return static_cast<int>(longZigzag(largest)); }
  int64_t longZigzag(uint64_t largest) {
    const auto coded = static_cast<int64_t>(varint(0, 2 * largest));
    return coded % 2 == 0 ? coded / 2 : -(coded + 1) / 2;
  }

 private:
  uint64_t within(uint64_t value, uint64_t low, uint64_t high) {
    if (value < low || value > high) fail(Outcome::kCorrupt);
    return outcome_ == Outcome::kDone ? value : 0;
  }

  std::span<const uint8_t> bytes_;
  Outcome outcome_ = Outcome::kDone;
};

}  // namespace tetrakis::reference
