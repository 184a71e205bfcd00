// SPDX-License-Identifier: Apache-2.0
// StepUnits, and StepGrid above it, count samples in *units*: 64-bit integers times a power of two,
// of which a step (a relative step, or the step of the header) has 2^30 to 2^31. Multiples of the
// step and planes through samples are sums of units, so that every machine makes the same contexts
// of them. A unit is a 2^30th of the step, far below what the rounding of a float leaves where the
// step is worth its bytes.
//
//   kFar   2^59       samples beyond are clamped; planes through three samples stay below 2^62
//   kWide  2^62 - 1   the base and samples beside it: differences of two have 64 bits
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <type_traits>

#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline steps {

inline constexpr int64_t kFar = int64_t{1} << 59;
inline constexpr int64_t kWide = (int64_t{1} << 62) - 1;

/// A step: `step` units of 2^exponent each.
struct StepUnits {
  int64_t step;
  int exponent;
};

/// How many binary digits a number has.
inline int digitsOf(uint64_t n) {
  return static_cast<int>(std::bit_width(n));
}

/// A finite double by its bits: digits * 2^exponent, without its sign.
struct DoubleDigits {
  uint64_t digits;
  int exponent;

  explicit DoubleDigits(double number) {
    constexpr int kStored = 52;
    const auto bits = std::bit_cast<uint64_t>(number);
    const int field = static_cast<int>(bits >> kStored & 0x7ff);
    const uint64_t stored = bits & ((uint64_t{1} << kStored) - 1);
    digits = field > 0 ? stored | uint64_t{1} << kStored : stored;
    exponent = std::max(field, 1) - 1075;
  }
};

/// The largest power of two that is not above a step: its exponent.
inline int stepExponent(double step) {
  const DoubleDigits of(step);
  return of.exponent + digitsOf(of.digits) - 1;
}

/// A step, which is finite and above 0, in its 31 highest binary digits.
inline StepUnits stepUnits(double step) {
  const DoubleDigits of(step);
  const int excess = digitsOf(of.digits) - 31;
  const uint64_t kept =
      excess > 0 ? (of.digits + (uint64_t{1} << (excess - 1))) >> excess : of.digits << -excess;
  return {static_cast<int64_t>(kept), of.exponent + excess};
}

/// n / d rounded towards minus infinity; d > 0.
inline int64_t floorDiv(int64_t n, int64_t d) {
  return n / d - (n % d < 0);
}

/// n * 2^shift, rounded to the nearest integer, halves up, and clamped to +-limit.
inline int64_t scaled(int64_t n, int shift, int64_t limit = kFar) {
  if (n == 0 || shift < -63) return 0;  // at most half of 1 is left
  if (shift < 0) {
    const int64_t half = n >> (-shift - 1) & 1;
    return std::clamp((n >> -shift) + half, -limit, limit);
  }
  const uint64_t size = n < 0 ? 0 - static_cast<uint64_t>(n) : static_cast<uint64_t>(n);
  const bool beyond = shift > 62 || size > static_cast<uint64_t>(limit) >> shift;
  if (beyond) return n < 0 ? -limit : limit;
  return n * (int64_t{1} << shift);
}

/// Whether a sample is a finite number.
template <class T>
bool isNumber(T sample) {
  if constexpr (std::is_floating_point_v<T>)
    return (std::bit_cast<uint32_t>(sample) >> 23 & 0xff) != 0xff;
  else
    return true;
}

template <class T>
bool isNaN(T sample) {
  if constexpr (std::is_floating_point_v<T>)
    return (std::bit_cast<uint32_t>(sample) & 0x7fffffff) > 0x7f800000;
  else
    return false;
}

/// A sample in units of 2^exponent, beyond +-limit that. Infinities and NaNs have their digits.
template <class T>
int64_t inUnits(T sample, int exponent, int64_t limit = kFar) {
  const int shift = spacingExponent(sample) - exponent;
  if constexpr (std::is_floating_point_v<T>) {
    const auto bits = std::bit_cast<uint32_t>(sample);
    const int64_t digits = (bits & 0x7fffff) | ((bits >> 23 & 0xff) != 0 ? 0x800000 : 0);
    return scaled(bits >> 31 ? -digits : digits, shift, limit);
  } else {
    return scaled(static_cast<int64_t>(sample), shift, limit);
  }
}

/// The finite float nearest to n * 2^exponent, ties to even digits; 0 has no sign.
inline float nearestFloat(int64_t n, int exponent) {
  constexpr uint32_t kLargest = 0x7f7fffff;
  const auto magnitude = static_cast<uint64_t>(std::abs(n));
  const int spacing = std::max(digitsOf(magnitude) + exponent - 24, -149);
  const int drop = spacing - exponent;  // digits that the float has no room for
  uint64_t digits = drop > 0 ? 0 : magnitude << -drop;
  if (drop > 0 && drop < 64) {
    const uint64_t half = uint64_t{1} << (drop - 1), rest = magnitude & (2 * half - 1);
    digits = magnitude >> drop;
    digits += rest > half || (rest == half && digits % 2 == 1);
  }
  // Digits of 2^24 carry into the exponent; below 2^23 the exponent field is 0.
  const uint64_t bits = (static_cast<uint64_t>(spacing + 149) << 23) + digits;
  const auto finite = static_cast<uint32_t>(std::min<uint64_t>(bits, kLargest));
  return std::bit_cast<float>(n < 0 && digits > 0 ? finite | 0x80000000u : finite);
}

/// The sample nearest to n * 2^exponent, |n| < 2^63. Integers round halves up.
template <class T>
T nearestSample(int64_t n, int exponent) {
  if constexpr (std::is_floating_point_v<T>) {
    return nearestFloat(n, exponent);
  } else {
    constexpr int64_t kLow = std::numeric_limits<T>::lowest(),
                      kHigh = std::numeric_limits<T>::max();
    return static_cast<T>(std::clamp(scaled(n, exponent), kLow, kHigh));
  }
}

/// What steps stand for, and which steps samples lie at: base + q * step, in units of the step.
class StepGrid {
 public:
  StepGrid(double base, double step) : units_(stepUnits(step)), exponent_(stepExponent(step)) {
    const DoubleDigits of(base);
    const auto digits = static_cast<int64_t>(of.digits);
    base_ = scaled(std::bit_cast<uint64_t>(base) >> 63 ? -digits : digits,
                   of.exponent - units_.exponent, kWide);
  }

  /// stepExponent() of the step.
  int exponent() const { return exponent_; }

  /// Step q in units of 2^exponent, beyond +-kFar that.
  int64_t inUnitsOf(int exponent, int32_t q) const {
    return scaled(at(q), units_.exponent - exponent);
  }

  /// The sample nearest to step q.
  template <class T>
  T sampleNear(int32_t q) const {
    return nearestSample<T>(at(q), units_.exponent);
  }

  /// The multiple of 2^-fraction_bits steps nearest to a sample, halves up, up to `most` of them.
  /// Infinities and NaNs have their digits.
  template <class T>
  int32_t nearest(T sample, int fraction_bits = 0, int64_t most = 1 << 29) const {
    const int64_t rise = inUnits(sample, units_.exponent, kWide) - base_;
    const int64_t parts = scaled(rise, fraction_bits, kWide) + units_.step / 2;
    return static_cast<int32_t>(std::clamp(floorDiv(parts, units_.step), -most, most));
  }

 private:
  int64_t at(int32_t q) const { return base_ + q * units_.step; }  // less than 2^63

  StepUnits units_;
  int exponent_;
  int64_t base_;  ///< in units
};

}  // namespace tetrakis::inline steps
