// SPDX-License-Identifier: Apache-2.0
// A step stands for a sample, which is computed here.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/integer_scale.hpp"

namespace tetrakis::inline steps {

/// base + q * step as the nearest finite sample of its type.
template <class T>
T restore(double base, double step, int32_t q) {
  const double value = base + static_cast<double>(q) * step;
  constexpr auto kLow = static_cast<double>(std::numeric_limits<T>::lowest());
  constexpr auto kHigh = static_cast<double>(std::numeric_limits<T>::max());
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(std::clamp(value, kLow, kHigh));
  } else {
    return static_cast<T>(std::clamp(std::round(value), kLow, kHigh));
  }
}

/// What heights in units of 2^-fraction_bits steps stand for: sample = base + q * step.
struct Scale {
  double base, step;
};

template <class T>
void restoreAll(std::span<const int32_t> heights, int fraction_bits, const Scale& scale,
                T* samples) {
  if constexpr (std::is_integral_v<T> && sizeof(T) < sizeof(int32_t)) {
    const IntegerScale<T> integer(scale.base, scale.step);
    if (integer.applies()) {
      for (size_t i = 0; i < heights.size(); ++i)
        samples[i] = integer.restore(wholeStep(heights[i], fraction_bits));
      return;
    }
  }
  for (size_t i = 0; i < heights.size(); ++i)
    samples[i] = restore<T>(scale.base, scale.step, wholeStep(heights[i], fraction_bits));
}

}  // namespace tetrakis::inline steps
