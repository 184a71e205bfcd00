// SPDX-License-Identifier: Apache-2.0
// A step stands for a sample, which is computed here.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace tetrakis::inline geometry {

/// base + q * step as the nearest sample of its type; integers saturate at their type's range.
template <class T>
T restore(double base, double step, int32_t q) {
  const double value = base + static_cast<double>(q) * step;
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(value);
  } else {
    const double low = static_cast<double>(std::numeric_limits<T>::min());
    const double high = static_cast<double>(std::numeric_limits<T>::max());
    return static_cast<T>(std::clamp(std::round(value), low, high));
  }
}

}  // namespace tetrakis::inline geometry
