// SPDX-License-Identifier: Apache-2.0
// A BitPlane holds one bit a sample, 64 samples in a word, so that one operation on a word counts,
// joins or moves the marks of 64 samples.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/view.hpp"

namespace tetrakis::inline base {

/// Samples in a word, the first in its lowest bit.
inline constexpr uint32_t kWordBits = 64;

/// The lowest bits of a word, up to all 64.
constexpr uint64_t lowBits(uint32_t count) {
  return count < kWordBits ? (uint64_t{1} << count) - 1 : ~uint64_t{0};
}

/// The lowest bits of eight bytes, one behind the other.
inline uint64_t bitsOf(const uint8_t* eight) {
  uint64_t bytes = 0;
  for (int i = 0; i < 8; ++i) bytes |= uint64_t{eight[i]} << (8 * i);
  return ((bytes & 0x0101010101010101) * 0x0102040810204080) >> 56;
}

/// The inverse of bitsOf(): the lowest eight bits become a byte each, 0 or 1.
inline void putBits(uint64_t bits, uint8_t* eight) {
  const uint64_t apart = ((bits & 0xff) * 0x0101010101010101) & 0x8040201008040201;
  const uint64_t bytes = ((apart + 0x7f7f7f7f7f7f7f7f) >> 7) & 0x0101010101010101;
  for (int i = 0; i < 8; ++i) eight[i] = static_cast<uint8_t>(bytes >> (8 * i));
}

/// Every other bit, from the lowest on.
constexpr uint32_t evenBits(uint64_t bits) {
  bits &= 0x5555555555555555;
  bits = (bits | bits >> 1) & 0x3333333333333333;
  bits = (bits | bits >> 2) & 0x0f0f0f0f0f0f0f0f;
  bits = (bits | bits >> 4) & 0x00ff00ff00ff00ff;
  bits = (bits | bits >> 8) & 0x0000ffff0000ffff;
  return static_cast<uint32_t>(bits | bits >> 16);
}

/// Between rows lies a word of zeros, so that neighbours along a row need no checks. Bits behind
/// the last sample of a row are 0.
class BitPlane {
 public:
  BitPlane() = default;
  explicit BitPlane(Extent extent)
      : extent_(extent), words_((extent.width + kWordBits - 1) / kWordBits) {
    bits_.resize(stride() * extent.height + 1);
  }
  /// marks: a byte a sample, 0 or 1.
  BitPlane(std::span<const uint8_t> marks, Extent extent) : BitPlane(extent) {
    for (uint32_t y = 0; y < extent.height; ++y)
      takeRow(marks.data() + size_t{y} * extent.width, y);
  }

  bool operator==(const BitPlane&) const = default;

  static uint64_t bytesOf(Extent extent) {
    const uint64_t words = uint64_t{extent.width} / kWordBits + 2;
    return sizeof(uint64_t) * (words * extent.height + 1);
  }

  Extent extent() const { return extent_; }
  uint32_t words() const { return words_; }             ///< of a row
  size_t stride() const { return size_t{words_} + 1; }  ///< from a row to the next, in words
  /// Word 0 of a row; words -1 and words() are 0.
  uint64_t* row(uint32_t y) { return bits_.data() + y * stride() + 1; }
  const uint64_t* row(uint32_t y) const { return bits_.data() + y * stride() + 1; }
  bool at(uint32_t x, uint32_t y) const { return row(y)[x / kWordBits] >> x % kWordBits & 1; }
  /// The bits of a word that are samples.
  uint64_t existing(uint32_t word) const { return lowBits(extent_.width - kWordBits * word); }

  /// Marks the samples that are not marked, and unmarks the others.
  void invert() {
    for (uint32_t y = 0; y < extent_.height; ++y)
      for (uint32_t k = 0; k < words_; ++k) row(y)[k] = ~row(y)[k] & existing(k);
  }
  bool all() const {
    for (uint32_t y = 0; y < extent_.height; ++y)
      for (uint32_t k = 0; k < words_; ++k)
        if (row(y)[k] != existing(k)) return false;
    return true;
  }
  /// 32 samples of a row at distances of 2^log2, from x on; 0 behind its end.
  uint32_t every(int log2, uint32_t x, uint32_t y) const {
    if (log2 == 0) return static_cast<uint32_t>(from(x, y));
    if (log2 == 1) return evenBits(from(x, y));
    uint32_t bits = 0;
    for (uint32_t i = 0; i < 32 && x < extent_.width; ++i, x += uint32_t{1} << log2)
      bits |= uint32_t{at(x, y)} << i;
    return bits;
  }

  /// A rectangle of the plane as a plane of its own.
  BitPlane cut(const Window& window) const {
    assert(window.isInside(extent_));
    BitPlane out(window.extent());
    for (uint32_t y = 0; y < window.height; ++y)
      for (uint32_t k = 0; k < out.words_; ++k)
        out.row(y)[k] = from(window.x + k * kWordBits, window.y + y) & out.existing(k);
    return out;
  }
  /// Marks what is marked in a plane whose first sample is put at (x, y).
  void mark(const BitPlane& part, uint32_t x, uint32_t y) {
    assert((Window{x, y, part.extent_.width, part.extent_.height}.isInside(extent_)));
    const uint32_t shift = x % kWordBits;
    for (uint32_t j = 0; j < part.extent_.height; ++j) {
      uint64_t* const to = row(y + j) + x / kWordBits;
      for (uint32_t k = 0; k < part.words_; ++k) {
        const uint64_t bits = part.row(j)[k];
        to[k] |= bits << shift;
        if (shift > 0 && bits >> (kWordBits - shift) != 0) to[k + 1] |= bits >> (kWordBits - shift);
      }
    }
  }

  /// How many of the first samples of a row are marked.
  uint64_t countBefore(uint32_t x, uint32_t y) const {
    const uint64_t* const bits = row(y);
    uint64_t count = 0;
    for (uint32_t k = 0; k < x / kWordBits; ++k)
      count += static_cast<uint64_t>(std::popcount(bits[k]));
    const uint32_t rest = x % kWordBits;
    return count + (rest > 0
                        ? static_cast<uint64_t>(std::popcount(bits[x / kWordBits] & lowBits(rest)))
                        : 0);
  }
  /// The marks that a view shows, a byte each.
  std::vector<uint8_t> bytes(const View& view = {}) const {
    const Extent shown = view.extentIn(extent_);
    std::vector<uint8_t> marks(shown.samples());
    for (uint32_t y = 0; y < shown.height; ++y) {
      uint8_t* const to = marks.data() + size_t{y} * shown.width;
      const uint32_t from = view.rowOf(y);
      uint32_t x = 0;
      if (view.isWhole()) {
        for (; x + 8 <= shown.width; x += 8)
          putBits(row(from)[x / kWordBits] >> x % kWordBits, to + x);
      }
      for (; x < shown.width; ++x) to[x] = at(view.firstColumn() + (x << view.level), from);
    }
    return marks;
  }

 private:
  /// 64 samples from x on.
  uint64_t from(uint32_t x, uint32_t y) const {
    const uint64_t* const bits = row(y) + x / kWordBits;
    const uint32_t shift = x % kWordBits;
    return shift == 0 ? *bits : bits[0] >> shift | bits[1] << (kWordBits - shift);
  }

  void takeRow(const uint8_t* marks, uint32_t y) {
    uint64_t* const bits = row(y);
    uint32_t x = 0;
    for (; x + 8 <= extent_.width; x += 8)
      bits[x / kWordBits] |= bitsOf(marks + x) << x % kWordBits;
    for (; x < extent_.width; ++x) bits[x / kWordBits] |= uint64_t{marks[x]} << x % kWordBits;
  }

  Extent extent_;
  uint32_t words_ = 0;
  std::vector<uint64_t> bits_;
};

/// The marks of a plane that several keep alive; null: every sample is marked.
using SharedBits = std::shared_ptr<const BitPlane>;

inline SharedBits sharedBits(Mask marks, Extent extent) {
  return marks.all() ? nullptr : std::make_shared<const BitPlane>(marks.bytes(), extent);
}
inline SharedBits shared(BitPlane marks) {
  return std::make_shared<const BitPlane>(std::move(marks));
}

/// The marks that a view shows, a byte each; none where every sample is marked.
inline std::vector<uint8_t> shownMarks(const SharedBits& marks, const View& view) {
  return marks == nullptr ? std::vector<uint8_t>() : marks->bytes(view);
}

}  // namespace tetrakis::inline base
