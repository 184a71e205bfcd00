// SPDX-License-Identifier: Apache-2.0
// The functions here turn floats into whole multiples of a unit, so that their sums are exact and
// the same on every machine. Digits of a float below the unit are cut off.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace tetrakis::inline facets {

/// Places between a float and the middle of two.
inline constexpr size_t kFloatPlaces = 8;

/// The float nearest to a multiple of the unit.
struct NearestFloat {
  uint32_t order;  ///< orderOf() it
  bool below;      ///< the multiple lies below it
  size_t place;    ///< of kFloatPlaces, by how far it does
};

class FacetUnit {
 public:
  static constexpr int kLeastExponent = 1, kMostExponent = 254;

  /// exponent: the exponent field of the floats whose spacing is the unit.
  explicit FacetUnit(int exponent) : exponent_(exponent) {}

  /// The exponent for samples of such a magnitude. Sums of four of them have 63 bits; floats of a
  /// 2^36th of it are whole multiples.
  static int exponentFor(float largest) {
    return std::clamp(fieldOf(std::bit_cast<uint32_t>(largest)) - kMostShift, kLeastExponent,
                      kMostExponent);
  }

  /// Less than 2^60 in magnitude, whatever the sample is.
  int64_t multiplesOf(float sample) const {
    const auto bits = std::bit_cast<uint32_t>(sample);
    const bool normal = (bits >> (kMantissaBits - 1) & 0xff) != 0;
    const int64_t mantissa = (bits & (kHidden - 1)) | (normal ? kHidden : 0);
    const int shift = fieldOf(bits) - exponent_;
    const int64_t size = shift >= 0 ? mantissa << std::min(shift, kMostShift)
                                    : mantissa >> std::min(-shift, kMantissaBits);
    return bits >> 31 ? -size : size;
  }

  /// Half the distance from the sample to the next float of its binade, in units.
  int64_t halfSpacing(float sample) const {
    const int shift = fieldOf(std::bit_cast<uint32_t>(sample)) - exponent_ - 1;
    return shift >= 0 ? int64_t{1} << std::min(shift, kMostShift) : 0;
  }

  /// Halves go to the larger magnitude.
  NearestFloat nearest(int64_t multiples) const {
    if (multiples == 0) return {0, false, 0};
    const bool negative = multiples < 0;
    const auto size = static_cast<uint64_t>(std::abs(multiples));
    const int shift = std::max(static_cast<int>(std::bit_width(size)) - kMantissaBits,
                               kLeastExponent - exponent_);
    if (shift <= 0) return {ordered(size << -shift, exponent_ + shift, negative), negative, 0};
    const uint64_t mantissa = (size + (uint64_t{1} << (shift - 1))) >> shift;
    const auto off = static_cast<int64_t>(size - (mantissa << shift));
    const uint64_t place = static_cast<uint64_t>(std::abs(off)) * 2 * kFloatPlaces >> shift;
    return {ordered(mantissa, exponent_ + shift, negative), (off < 0) != negative,
            std::min(static_cast<size_t>(place), kFloatPlaces - 1)};
  }

 private:
  static constexpr int kMantissaBits = 24, kMostShift = 36;
  static constexpr uint32_t kHidden = 1u << (kMantissaBits - 1);

  /// The exponent field; denormal floats have the spacing of those of field 1.
  static int fieldOf(uint32_t bits) {
    return std::max(static_cast<int>(bits >> (kMantissaBits - 1) & 0xff), 1);
  }

  /// mantissa: from 2^23 to 2^24, or below where the exponent is 1. Beyond the largest float: that.
  static uint32_t ordered(uint64_t mantissa, int exponent, bool negative) {
    constexpr uint64_t kLargest = 0x7f7fffff;
    const uint64_t bits = (static_cast<uint64_t>(exponent - 1) << (kMantissaBits - 1)) + mantissa;
    const auto finite = static_cast<uint32_t>(std::min(bits, kLargest));
    return negative ? ~finite : finite;
  }

  int exponent_;
};

}  // namespace tetrakis::inline facets
