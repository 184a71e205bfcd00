// SPDX-License-Identifier: Apache-2.0
// A step stands for a sample, which is computed here.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace tetrakis::inline geometry {

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

}  // namespace tetrakis::inline geometry
