// SPDX-License-Identifier: Apache-2.0
// Samples count in *units* here: 64-bit integers times a power of two, of which a step (a relative
// step, or the step of the header) has 2^30 to 2^31. Multiples of the step and planes through
// samples are sums of units, so that every machine makes the same contexts of them. A unit is a
// 2^30th of the step, far below what the rounding of a float leaves where the step is worth its
// bytes.
//
//   kFar  2^59   samples beyond are clamped; planes through three samples stay below 2^62
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

/// A relative step: `step` units of 2^exponent each.
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

/// n * 2^shift, rounded to the nearest integer, halves up, and clamped to +-kFar.
inline int64_t scaled(int64_t n, int shift) {
  if (shift <= 0) {
    const int down = std::min(-shift, 62);
    const int64_t half = down > 0 ? int64_t{1} << (down - 1) : 0;
    return std::clamp((n + half) >> down, -kFar, kFar);
  }
  if (n == 0) return 0;
  if (digitsOf(static_cast<uint64_t>(std::abs(n))) + int64_t{shift} <= 59)
    return n * (int64_t{1} << shift);
  return n < 0 ? -kFar : kFar;
}

/// Whether a sample is a finite number.
template <class T>
bool isNumber(T sample) {
  if constexpr (std::is_floating_point_v<T>)
    return (std::bit_cast<uint32_t>(sample) >> 23 & 0xff) != 0xff;
  else
    return true;
}

/// A sample that is a number, in units of 2^exponent; kFar and beyond are +-kFar.
template <class T>
int64_t inUnits(T sample, int exponent) {
  const int shift = spacingExponent(sample) - exponent;
  if constexpr (std::is_floating_point_v<T>) {
    const auto bits = std::bit_cast<uint32_t>(sample);
    const int64_t digits = (bits & 0x7fffff) | ((bits >> 23 & 0xff) != 0 ? 0x800000 : 0);
    return scaled(bits >> 31 ? -digits : digits, shift);
  } else {
    return scaled(static_cast<int64_t>(sample), shift);
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

/// The grid of a header's base and step.
class StepGrid {
 public:
  StepGrid(double base, double step) : units_(stepUnits(step)), exponent_(stepExponent(step)) {
    const DoubleDigits of(base);
    const auto digits = static_cast<int64_t>(of.digits);
    base_ = scaled(std::bit_cast<uint64_t>(base) >> 63 ? -digits : digits,
                   of.exponent - units_.exponent);
  }

  /// stepExponent() of the step.
  int exponent() const { return exponent_; }

  /// The step nearest to a sample, halves up, up to 2^29. Infinities and NaNs have their digits.
  int32_t nearest(float sample) const {
    constexpr int64_t kMost = 1 << 29;
    const int64_t rise = inUnits(sample, units_.exponent) - base_;
    return static_cast<int32_t>(
        std::clamp(floorDiv(rise + units_.step / 2, units_.step), -kMost, kMost));
  }

 private:
  StepUnits units_;
  int exponent_;
  int64_t base_;  ///< in units
};

}  // namespace tetrakis::inline steps
