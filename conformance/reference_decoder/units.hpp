// SPDX-License-Identifier: Apache-2.0
// Reference decoder: units of steps, the integers that samples are counted in (docs/FORMAT.md,
// section 8.1, "Units").
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "conformance/reference_decoder/samples.hpp"

namespace tetrakis::reference {

inline constexpr int64_t kFar = int64_t{1} << 59, kWide = (int64_t{1} << 62) - 1;

inline int64_t floorDiv(int64_t n, int64_t d) {
  return n >= 0 ? n / d : -((d - 1 - n) / d);
}

inline int digitsOf(uint64_t n) {
  return static_cast<int>(std::bit_width(n));
}

/// An f64 without its sign: digits * 2^exponent.
struct Digits {
  uint64_t digits;
  int exponent;

  explicit Digits(double number) {
    const auto bits = std::bit_cast<uint64_t>(number);
    const int field = static_cast<int>(bits >> 52 & 0x7FF);
    digits = (bits & 0xFFFFFFFFFFFFF) + (field > 0 ? uint64_t{1} << 52 : 0);
    exponent = std::max(field, 1) - 1075;
  }
  /// floor(log2 number)
  int log2() const { return digitsOf(digits) - 1 + exponent; }
};

/// A step is g units of 2^u.
struct Step {
  int64_t g = 0;
  int u = 0;

  explicit Step(double step) {
    const Digits of(step);
    const int more = digitsOf(of.digits) - 31;
    g = static_cast<int64_t>(more > 0 ? ((of.digits >> (more - 1)) + 1) >> 1 : of.digits << -more);
    u = of.exponent + more;
  }
};

/// near(n, s), or wide(n, s) with its limit
inline int64_t near(int64_t n, int s, int64_t limit = kFar) {
  if (n == 0 || s < -63) return 0;
  if (s < 0) return std::clamp((n >> -s) + (n >> (-s - 1) & 1), -limit, limit);
  const uint64_t size = n < 0 ? 0 - static_cast<uint64_t>(n) : static_cast<uint64_t>(n);
  if (digitsOf(size) + s > 62) return n < 0 ? -limit : limit;
  return std::clamp(n * (int64_t{1} << s), -limit, limit);
}

inline bool isNumber(const GeometryHeader& header, uint32_t bits) {
  return header.sample != kF32 || (bits >> 23 & 255) != 255;
}

/// count(S), or with the limit of wide()
inline int64_t unitsOf(const GeometryHeader& header, uint32_t bits, int u, int64_t limit = kFar) {
  int64_t n = static_cast<int32_t>(bits);
  if (header.sample == kF32) {
    const int64_t digits = (bits & 0x7FFFFF) + ((bits >> 23 & 255) != 0 ? 0x800000 : 0);
    n = bits >> 31 ? -digits : digits;
  } else if (header.sample == kU32) {
    n = bits;
  }
  return near(n, spacingOf(header, bits) - u, limit);
}

/// sample(M) of an f32: the nearest finite one, ties to even.
inline uint32_t floatOf(int64_t m, int u) {
  const uint64_t size = m < 0 ? 0 - static_cast<uint64_t>(m) : static_cast<uint64_t>(m);
  const int e = std::max(digitsOf(size) + u - 24, -149), drop = e - u;
  uint64_t digits = 0;
  if (drop <= 0) digits = size << -drop;
  if (drop > 0 && drop < 64) {
    const uint64_t below = size & ((uint64_t{2} << (drop - 1)) - 1),
                   half = uint64_t{1} << (drop - 1);
    digits = size >> drop;
    if (below > half || (below == half && digits % 2 == 1)) ++digits;
  }
  const uint64_t bits = (static_cast<uint64_t>(e + 149) << 23) + digits;
  const auto finite = static_cast<uint32_t>(std::min<uint64_t>(bits, 0x7F7FFFFF));
  return m < 0 && digits > 0 ? finite | 0x80000000 : finite;
}

/// sample(M)
inline uint32_t sampleAt(const GeometryHeader& header, int64_t m, int u) {
  constexpr int64_t kLeast[] = {0, -128, 0, -32768, 0, INT32_MIN};
  constexpr int64_t kLargest[] = {255, 127, 65535, 32767, UINT32_MAX, INT32_MAX};
  if (header.sample == kF32) return floatOf(m, u);
  const int64_t rounded = near(m, u);
  return static_cast<uint32_t>(std::clamp(rounded, kLeast[header.sample], kLargest[header.sample]));
}

/// B: the count of the base.
inline int64_t baseOf(const GeometryHeader& header, const Step& step) {
  const Digits of(header.base);
  const auto digits = static_cast<int64_t>(of.digits);
  return near(std::bit_cast<uint64_t>(header.base) >> 63 ? -digits : digits, of.exponent - step.u,
              kWide);
}

/// The bits of place(q) as a sample, and place(q) in units of 2^u.
inline uint32_t sampleNear(const GeometryHeader& header, int32_t q) {
  const Step step(header.step);
  return sampleAt(header, baseOf(header, step) + q * step.g, step.u);
}

inline int64_t placeOf(const GeometryHeader& header, int32_t q, int u) {
  const Step step(header.step);
  return near(baseOf(header, step) + q * step.g, step.u - u);
}

/// steps(S, f) of bits
inline int64_t stepsOf(const GeometryHeader& header, uint32_t bits, int f = 0) {
  constexpr int64_t kMost = 1 << 29;
  const Step step(header.step);
  const int64_t rise = unitsOf(header, bits, step.u, kWide) - baseOf(header, step);
  return std::clamp(floorDiv(near(rise, f, kWide) + step.g / 2, step.g), -kMost, kMost);
}

}  // namespace tetrakis::reference
