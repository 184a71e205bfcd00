// SPDX-License-Identifier: Apache-2.0
// FieldWriter and FieldReader write and read the fields of a stream. Each structure lists its
// fields once, in visit(), and the two are visitors. Numbers are little endian; a varint is LEB128
// (7 bits a byte, low bits first), and a double goes without its low zero bytes, which round
// numbers have many of: u8 n, n high bytes. A structure may end with parts: kind, length, and as
// many bytes. Kinds rise, so that visit() asks for each in its turn; a part that is not asked for
// is skipped, and kept as bytes, or refused if its kind is below kMaySkip.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::inline stream {

/// Parts of this kind and above inform: a decoder that does not know one decodes the same.
inline constexpr uint64_t kMaySkip = 64;

/// Appends fields to a byte string.
class FieldWriter {
 public:
  static constexpr bool kReads = false;

  template <class T>
  void u8(const char*, T& value, uint64_t, uint64_t) {
    bytes.push_back(static_cast<uint8_t>(value));
  }
  template <class T>
  void varint(const char*, T& value, uint64_t, uint64_t) {
    put(static_cast<uint64_t>(value));
  }
  void u32(const char*, uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
  }
  void zigzag(const char*, int64_t& value, int64_t) {
    put((static_cast<uint64_t>(value) << 1) ^ static_cast<uint64_t>(value >> 63));
  }
  void f64(const char*, double& value, bool = false) {
    const auto bits = std::bit_cast<uint64_t>(value);
    const int zeros = std::countr_zero(bits) / 8;
    bytes.push_back(static_cast<uint8_t>(8 - zeros));
    for (int i = zeros; i < 8; ++i) bytes.push_back(static_cast<uint8_t>(bits >> (8 * i)));
  }
  void text(const char*, std::string& value) {
    put(value.size());
    bytes.insert(bytes.end(), value.begin(), value.end());
  }
  /// A field at the end of a part, which goes without the last fields that have their usual values.
  /// visitValue: visits the field.
  template <class T, class Visit>
  void unless(const T& usual, T& value, Visit&& visitValue) {
    const size_t begin = bytes.size();
    visitValue();
    usual_bytes_ = value == usual ? usual_bytes_ + bytes.size() - begin : 0;
  }
  /// All bytes that are left in a part.
  void rest(std::string& value) { bytes.insert(bytes.end(), value.begin(), value.end()); }
  /// A part, if there is one. visitBody: visits its fields. Returns whether there is one.
  template <class Body>
  bool part(uint64_t kind, bool is_there, Body&& visitBody) {
    if (!is_there) return false;
    FieldWriter body;
    visitBody(body);
    body.bytes.resize(body.bytes.size() - body.usual_bytes_);
    put(kind);
    put(body.bytes.size());
    bytes.insert(bytes.end(), body.bytes.begin(), body.bytes.end());
    return true;
  }
  /// A part that stands before all others, whatever its kind.
  template <class Body>
  void leadingPart(uint64_t kind, bool is_there, Body&& visitBody) {
    part(kind, is_there, visitBody);
  }
  /// Behind the last part that visit() asks for. later: parts that a reader skipped, as they were.
  void endParts(std::string& later) { rest(later); }
  /// Of readers: fails unless that holds.
  void require(const char*, bool) {}
  bool ok() const { return true; }
  void put(uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<uint8_t>(value | 0x80));
    bytes.push_back(static_cast<uint8_t>(value));
  }

  std::vector<uint8_t> bytes;

 private:
  size_t usual_bytes_ = 0;  ///< of the last fields: those that have their usual values
};

/// Takes fields off a byte string; the first failure sticks. Every field is checked against the
/// range that visit() states, so a structure read without failure is valid field by field.
class FieldReader {
 public:
  static constexpr bool kReads = true;

  explicit FieldReader(std::span<const uint8_t> bytes, size_t origin = 0)
      : bytes_(bytes), origin_(origin) {}

  template <class T>
  void u8(const char* name, T& value, uint64_t low, uint64_t high) {
    accept(name, next(), low, high, value);
  }
  template <class T>
  void varint(const char* name, T& value, uint64_t low, uint64_t high) {
    accept(name, take(), low, high, value);
  }
  void u32(const char*, uint32_t& value) {
    uint32_t read = 0;
    for (int i = 0; i < 4; ++i) read |= uint32_t{next()} << (8 * i);
    if (ok()) value = read;
  }
  void zigzag(const char* name, int64_t& value, int64_t largest) {
    const uint64_t raw = take();
    const auto signed_raw = static_cast<int64_t>((raw >> 1) ^ (~(raw & 1) + 1));
    if (!ok()) return;
    if (signed_raw < -largest || signed_raw > largest) {
      fail(name, "is " + std::to_string(signed_raw) + ", at most +-" + std::to_string(largest) +
                     " is allowed");
    } else {
      value = signed_raw;
    }
  }
  /// No NaN; infinite only where that is allowed.
  void f64(const char* name, double& value, bool infinite = false) {
    int size = 0;
    accept(name, next(), 0, 8, size);
    uint64_t bits = 0;
    for (int i = 8 - size; i < 8; ++i) bits |= uint64_t{next()} << (8 * i);
    const auto read = std::bit_cast<double>(bits);
    require(name, infinite ? !std::isnan(read) : std::isfinite(read));
    if (ok()) value = read;
  }
  void text(const char* name, std::string& value) {
    const uint64_t size = take();
    if (ok() && size > bytes_.size() - at_) fail(name, "reaches past the end of its structure");
    if (!ok()) return;
    value.assign(bytes_.begin() + static_cast<ptrdiff_t>(at_),
                 bytes_.begin() + static_cast<ptrdiff_t>(at_ + size));
    at_ += size;
  }
  template <class T, class Visit>
  void unless(const T& usual, T& value, Visit&& visitValue) {
    if (ok() && at_ == bytes_.size())
      value = usual;
    else
      visitValue();
  }
  void rest(std::string& value) {
    if (ok()) value.assign(bytes_.begin() + static_cast<ptrdiff_t>(at_), bytes_.end());
    if (ok()) at_ = bytes_.size();
  }
  template <class Body>
  bool part(uint64_t kind, bool, Body&& visitBody) {
    skipPartsBefore(kind);
    if (!ok() || at_ == bytes_.size() || nextKind() != kind) return false;
    FieldReader body = openPart();
    if (!ok()) return false;
    visitBody(body);
    body.expectEnd();
    if (!body.ok()) status_ = body.status_;
    return true;
  }
  template <class Body>
  void leadingPart(uint64_t kind, bool, Body&& visitBody) {
    if (!ok() || at_ == bytes_.size() || nextKind() != kind) return;
    FieldReader body = openPart();
    last_kind_.reset();
    if (ok()) visitBody(body);
  }
  void endParts(std::string& later) {
    skipPartsBefore({});
    later = std::move(skipped_);
  }
  void require(const char* name, bool holds) {
    if (!holds) fail(name, "is missing or out of range, or should not be there");
  }
  /// A varint that fails where fewer bytes would do.
  template <class T>
  void shortestVarint(const char* name, T& value, uint64_t low, uint64_t high) {
    const size_t begin = at_;
    const uint64_t raw = take();
    if (ok() && at_ - begin > 1 && bytes_[at_ - 1] == 0) fail(name, "has needless bytes");
    accept(name, raw, low, high, value);
  }
  /// LEB128; fails where it ends early or exceeds 64 bits.
  uint64_t take();
  void fail(const std::string& name, const std::string& why);

  bool ok() const { return status_.ok(); }
  bool starved() const { return starved_; }  ///< failed because the bytes ended
  const Status& status() const { return status_; }
  size_t position() const { return at_; }
  size_t origin() const { return origin_; }  ///< of the first byte

 private:
  uint8_t next();
  void expectEnd();
  /// Of the next part, which is not taken.
  uint64_t nextKind();
  /// Takes the next part: kinds shall not fall.
  FieldReader openPart();
  /// Those of lower kinds, or all.
  void skipPartsBefore(std::optional<uint64_t> kind);
  template <class T>
  void accept(const char* name, uint64_t raw, uint64_t low, uint64_t high, T& value) {
    if (isWithin(name, raw, low, high)) value = static_cast<T>(raw);
  }
  /// Whether nothing has failed, this range included.
  bool isWithin(const char* name, uint64_t raw, uint64_t low, uint64_t high);

  std::span<const uint8_t> bytes_;
  size_t origin_;
  size_t at_ = 0;
  std::optional<uint64_t> last_kind_;  ///< of the parts that were taken
  std::string skipped_;                ///< parts, with kinds and lengths
  bool starved_ = false;
  Status status_;
};

}  // namespace tetrakis::inline stream
