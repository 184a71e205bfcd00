// SPDX-License-Identifier: Apache-2.0
#include "api/height_steps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>

#include "api/samples.hpp"

namespace tetrakis {

namespace {

constexpr double kMostSteps = 1 << 26;
constexpr double kLossySteps = 1 << 20;  // finer than any lossy stream resolves

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

/// The samples, their range, and the middle of the steps.
template <class T>
class Stepper {
 public:
  Stepper(const T* samples, size_t count) : samples_(samples), count_(count) {
    const auto [low, high] = std::minmax_element(samples, samples + count);
    low_ = static_cast<double>(*low);
    range_ = static_cast<double>(*high) - low_;
  }

  double range() const { return range_; }
  bool fits(double step) const { return range_ / step < kMostSteps; }

  HeightSteps with(double step) const {
    HeightSteps out;
    out.step = step;
    out.base = low_ + step * std::floor(range_ / step / 2);
    if constexpr (std::is_floating_point_v<T>) out.base = step * std::round(out.base / step);
    out.steps.resize(count_);
    out.exact = true;
    for (size_t i = 0; i < count_; ++i) {
      out.steps[i] = quantise(out, i);
      out.exact &= same(restore<T>(out.base, step, out.steps[i]), samples_[i]);
    }
    out.range_bits =
        std::bit_width(static_cast<uint32_t>(std::min(range_ / step, kMostSteps)) + 1u);
    return out;
  }

  /// Whether `step` restores every sample; stops at the first that it does not.
  bool restores(double step) const {
    HeightSteps trial;
    trial.step = step;
    trial.base = step * std::round((low_ + range_ / 2) / step);
    for (size_t i = 0; i < count_; ++i) {
      if (!same(restore<T>(trial.base, step, quantise(trial, i)), samples_[i])) return false;
    }
    return true;
  }

  /// Greatest common divisor of the differences between integer samples.
  double commonDivisor() const {
    uint64_t divisor = 0;
    for (size_t i = 0; i < count_ && divisor != 1; ++i) {
      divisor = std::gcd(divisor, static_cast<uint64_t>(static_cast<double>(samples_[i]) - low_));
    }
    return divisor == 0 ? 1 : static_cast<double>(divisor);
  }

 private:
  static bool same(T a, T b) {
    if constexpr (std::is_floating_point_v<T>) {
      return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
    } else {
      return a == b;
    }
  }
  int32_t quantise(const HeightSteps& s, size_t i) const {
    return static_cast<int32_t>(std::lround((static_cast<double>(samples_[i]) - s.base) / s.step));
  }

  const T* samples_;
  size_t count_;
  double low_ = 0, range_ = 0;
};

/// The exponent of the lowest set bit over all samples: 2^that divides every one.
int lowestBit(const float* samples, size_t count) {
  int lowest = std::numeric_limits<int>::max();
  for (size_t i = 0; i < count; ++i) {
    if (samples[i] == 0) continue;
    int exponent = 0;
    const double fraction = std::frexp(static_cast<double>(samples[i]), &exponent);
    const auto mantissa = static_cast<uint32_t>(std::ldexp(std::abs(fraction), 24));
    lowest = std::min(lowest, exponent - 24 + std::countr_zero(mantissa));
  }
  return lowest == std::numeric_limits<int>::max() ? 0 : lowest;
}

double powerOfTwoBelow(double x) {
  return std::exp2(std::floor(std::log2(x)));
}

double lossyStep(double range, double finest_useful) {
  double step = powerOfTwoBelow(range / kLossySteps) * 2;
  if (finest_useful > 0) step = std::min(step, powerOfTwoBelow(finest_useful));
  return step;
}

Status checkFinite(const tks_heights& heights) {
  const auto* samples = static_cast<const float*>(heights.data);
  for (size_t i = 0; i < size_t{heights.width} * heights.height; ++i) {
    if (std::isfinite(samples[i])) continue;
    return {TKS_USAGE, "The height in column " + std::to_string(i % heights.width) + ", row " +
                           std::to_string(i / heights.width) +
                           " is not a finite number; fill voids before encoding."};
  }
  return {};
}

double chooseFloatStep(const Stepper<float>& stepper, const tks_heights& heights,
                       double finest_useful) {
  if (stepper.range() == 0) return 1;
  for (const double step : {1.0, 0.1, 0.01, 0.001}) {
    if (stepper.fits(step) && stepper.restores(step)) return step;
  }
  const double binary = std::exp2(
      lowestBit(static_cast<const float*>(heights.data), size_t{heights.width} * heights.height));
  if (stepper.fits(binary) && stepper.restores(binary)) return binary;
  return lossyStep(stepper.range(), finest_useful);
}

}  // namespace

Result<HeightSteps> toSteps(const tks_heights& heights, double wanted_step, double finest_useful) {
  if (heights.sample == TKS_F32) {
    if (Status status = checkFinite(heights); !status.ok()) return status;
  }
  return withSampleType(heights.sample, [&](auto type) -> Result<HeightSteps> {
    using T = decltype(type);
    const Stepper<T> stepper(static_cast<const T*>(heights.data),
                             size_t{heights.width} * heights.height);
    double step = wanted_step;
    if (step <= 0) {
      if constexpr (std::is_floating_point_v<T>) {
        step = chooseFloatStep(stepper, heights, finest_useful);
        // A constant terrain of any value is its own base.
        if (stepper.range() == 0 && heights.data != nullptr) {
          HeightSteps flat;
          flat.steps.assign(size_t{heights.width} * heights.height, 0);
          flat.base = static_cast<double>(static_cast<const T*>(heights.data)[0]);
          flat.exact = !std::signbit(flat.base) || flat.base != 0;
          return flat;
        }
      } else {
        step = stepper.commonDivisor();
        while (!stepper.fits(step)) step *= 2;
      }
    }
    if (!stepper.fits(step)) {
      return Status(
          TKS_USAGE,
          "A step of " + std::to_string(step) +
              " divides the range of the heights into more than 2^26 parts; give a larger one.");
    }
    return stepper.with(step);
  });
}

void fromSteps(const std::vector<int32_t>& steps, const GeometryHeader& header, void* out) {
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    using T = decltype(type);
    T* samples = static_cast<T*>(out);
    for (size_t i = 0; i < steps.size(); ++i)
      samples[i] = restore<T>(header.base, header.step, steps[i]);
  });
}

}  // namespace tetrakis
