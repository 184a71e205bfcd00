// SPDX-License-Identifier: Apache-2.0
// restore() computes the sample that a step stands for, in the sample's own type.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/integer_scale.hpp"
#include "codec/geometry/steps/sample_order.hpp"

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

/// The base and step of heights in units of 2^-fraction_bits steps: sample = base + q * step.
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

/// Restores the samples from `first` on, corrections included, until `samples` is full.
template <class T>
void restoreCorrected(const DecodedHeights& decoded, size_t first, const Scale& scale,
                      std::span<T> samples) {
  const DecodedGeometry& geometry = decoded.geometry;
  restoreAll(std::span(geometry.heights).subspan(first, samples.size()), geometry.fraction_bits,
             scale, samples.data());
  if (decoded.corrections.empty()) return;
  for (size_t i = 0; i < samples.size(); ++i) {
    const auto correction = static_cast<uint32_t>(decoded.corrections[first + i]);
    samples[i] = fromOrder<T>(orderOf(samples[i]) + correction);
  }
}

}  // namespace tetrakis::inline steps
