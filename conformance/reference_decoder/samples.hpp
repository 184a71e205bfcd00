// SPDX-License-Identifier: Apache-2.0
// Reference decoder: samples of heights, and their orders (docs/FORMAT.md, sections 8 and 8.1).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {

/// FORMAT 8, "Samples": q of a value.
inline int32_t stepOf(int32_t v, int f) {
  return f == 0 ? v : static_cast<int32_t>((v + (int64_t{1} << (f - 1))) >> f);
}

/// The bits of the sample that a number becomes.
inline uint32_t sampleOf(const GeometryHeader& header, double sample) {
  constexpr double kLeast[] = {0, -128, 0, -32768, 0, -2147483648.0};
  constexpr double kLargest[] = {255, 127, 65535, 32767, 4294967295.0, 2147483647};
  if (header.sample == kF32) return std::bit_cast<uint32_t>(static_cast<float>(sample));
  const double clamped =
      std::clamp(std::round(sample), kLeast[header.sample], kLargest[header.sample]);
  return static_cast<uint32_t>(static_cast<int64_t>(clamped));
}

/// FORMAT 8, "Samples": the bits of a height, which is no infinite float.
inline uint32_t heightSampleOf(const GeometryHeader& header, int32_t q) {
  constexpr double kLargestFloat = 0x1.FFFFFEp127;
  const double height = header.base + q * header.step;
  if (header.sample != kF32) return sampleOf(header, height);
  return sampleOf(header, std::clamp(height, -kLargestFloat, kLargestFloat));
}

/// FORMAT 8.1, "Order": the word of a sample, and back (it is its own inverse).
inline uint32_t orderOf(const GeometryHeader& header, uint32_t bits) {
  return header.sample == kF32 && bits >> 31 ? bits ^ 0x7FFFFFFF : bits;
}

/// FORMAT 8.1, "Of samples": e of the bits of a sample.
inline int spacingOf(const GeometryHeader& header, uint32_t bits) {
  return header.sample == kF32 ? std::max(static_cast<int>(bits >> 23 & 255), 1) - 150 : 0;
}

/// "Modulo 2^bits of the type": a word of 8 or 16 bits, with its sign.
inline uint32_t narrow(const GeometryHeader& header, uint32_t bits) {
  switch (header.sample) {
    case kU8:
      return static_cast<uint8_t>(bits);
    case kI8:
      return static_cast<uint32_t>(static_cast<int8_t>(bits));
    case kU16:
      return static_cast<uint16_t>(bits);
    case kI16:
      return static_cast<uint32_t>(static_cast<int16_t>(bits));
    default:
      return bits;
  }
}

}  // namespace tetrakis::reference
