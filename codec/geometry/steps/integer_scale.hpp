// SPDX-License-Identifier: Apache-2.0
// IntegerScale turns integer steps into small integer samples without floating point.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tetrakis::inline steps {

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

}  // namespace tetrakis::inline steps
