// SPDX-License-Identifier: Apache-2.0
// restore() computes the sample base + q * step of a step q, and inSteps() the step and the
// correction that stand for a sample that is known otherwise; both with the same bits on every
// machine, by integers where these suffice (IntegerScale).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/geometry/steps/step_units.hpp"

namespace tetrakis::inline steps {

// IntegerScale turns integer steps into small integer samples without floating point.

/// The class applies to integer samples of up to 16 bits with a whole base and step: base + q *
/// step is a whole number that doubles hold exactly, so that 32-bit integers hold it as well once q
/// is clamped to the range in which it makes a difference.
template <class T>
class IntegerScale {
 public:
  IntegerScale(double base, double step)
      : applies_(isWhole(base) && isWhole(step)),
        base_(applies_ ? static_cast<int32_t>(base) : 0),
        step_(applies_ ? static_cast<int32_t>(step) : 1),
        least_(quotient(kLow - base_) - 1),
        most_(quotient(kHigh - base_) + 1) {}

  bool applies() const { return applies_; }
  T restore(int32_t q) const {
    const int32_t sample = base_ + std::min(std::max(q, least_), most_) * step_;
    return static_cast<T>(std::min(std::max(sample, kLow), kHigh));
  }

 private:
  /// All sums stay below 2^30.
  static constexpr double kMost = 1 << 26;
  static constexpr int32_t kLow = std::numeric_limits<T>::min();
  static constexpr int32_t kHigh = std::numeric_limits<T>::max();

  static bool isWhole(double x) { return std::abs(x) <= kMost && x == std::floor(x); }
  /// The quotient, truncated.
  int32_t quotient(int32_t difference) const { return difference / step_; }

  bool applies_;
  int32_t base_, step_, least_, most_;
};

// restore() computes the sample that a step stands for, in the sample's own type.

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

// inSteps() expresses a sample that is known without steps (neighbours restore it, or it stands in
// a table of values) as a height between steps and a correction that leads from there to the very
// sample, because everything behind the decoder of heights works on steps.

struct ValueInSteps {
  int32_t height;      ///< the nearest multiple of 2^-fraction_bits steps, up to 2^29
  int32_t correction;  ///< to the value, from the sample that the nearest whole step restores
};

/// grid: of the header's base and step.
template <class T>
ValueInSteps inSteps(T value, const GeometryHeader& header, const StepGrid& grid,
                     int fraction_bits) {
  ValueInSteps out{isNaN(value) ? 0 : grid.nearest(value, fraction_bits), 0};
  const T near = restore<T>(header.base, header.step, wholeStep(out.height, fraction_bits));
  out.correction = static_cast<int32_t>(orderOf(value) - orderOf(near));
  return out;
}

}  // namespace tetrakis::inline steps
