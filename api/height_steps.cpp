// SPDX-License-Identifier: Apache-2.0
#include "api/height_steps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>

#include "api/integer_scale.hpp"
#include "api/sample_order.hpp"
#include "api/samples.hpp"
#include "api/voids.hpp"

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

template <class T>
void restoreAll(const DecodedGeometry& geometry, const GeometryHeader& header, T* samples) {
  const int32_t* heights = geometry.heights.data();
  const size_t count = geometry.heights.size();
  const int fraction_bits = geometry.fraction_bits;
  if constexpr (std::is_integral_v<T> && sizeof(T) < sizeof(int32_t)) {
    const IntegerScale<T> scale(header.base, header.step);
    if (scale.applies()) {
      for (size_t i = 0; i < count; ++i)
        samples[i] = scale.restore(wholeStep(heights[i], fraction_bits));
      return;
    }
  }
  for (size_t i = 0; i < count; ++i)
    samples[i] = restore<T>(header.base, header.step, wholeStep(heights[i], fraction_bits));
}

template <class T>
bool same(T a, T b) {
  return orderOf(a) == orderOf(b);
}

/// The valid samples, their range, and the middle of the steps.
template <class T>
class Stepper {
 public:
  Stepper(const tks_heights& heights, const std::vector<uint8_t>& valid)
      : samples_(static_cast<const T*>(heights.data)),
        count_(size_t{heights.width} * heights.height),
        valid_(valid.empty() ? nullptr : valid.data()) {
    const SampleRange range = rangeOf(heights, valid);
    low_ = range.low;
    range_ = range.high - range.low;
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
    forEachValid([&](size_t i) {
      out.steps[i] = quantise(out, i);
      out.exact &= same(restore<T>(out.base, step, out.steps[i]), samples_[i]);
    });
    out.range_bits =
        std::bit_width(static_cast<uint32_t>(std::min(range_ / step, kMostSteps)) + 1u);
    return out;
  }

  /// All valid samples are one value, their base; or there is none.
  HeightSteps flat() const {
    HeightSteps out;
    out.steps.assign(count_, 0);
    out.base = low_;
    out.exact = true;
    const T value = restore<T>(out.base, out.step, 0);
    forEachValid([&](size_t i) { out.exact &= same(value, samples_[i]); });
    return out;
  }

  /// Whether `step` restores every sample.
  bool restores(double step) const {
    HeightSteps trial;
    trial.step = step;
    trial.base = step * std::round((low_ + range_ / 2) / step);
    for (size_t i = 0; i < count_; ++i) {
      if (!isValid(i)) continue;
      if (!same(restore<T>(trial.base, step, quantise(trial, i)), samples_[i])) return false;
    }
    return true;
  }

  /// Greatest common divisor of the differences between integer samples.
  double commonDivisor() const {
    uint64_t divisor = 0;
    for (size_t i = 0; i < count_ && divisor != 1; ++i) {
      if (!isValid(i)) continue;
      divisor = std::gcd(divisor, static_cast<uint64_t>(static_cast<double>(samples_[i]) - low_));
    }
    return divisor == 0 ? 1 : static_cast<double>(divisor);
  }

  /// The largest power of two that divides every float; 1 if all are 0.
  double commonPowerOfTwo() const {
    int lowest = std::numeric_limits<int>::max();
    forEachValid([&](size_t i) {
      if (samples_[i] == 0) return;
      int exponent = 0;
      const double fraction = std::frexp(static_cast<double>(samples_[i]), &exponent);
      const auto mantissa = static_cast<uint32_t>(std::ldexp(std::abs(fraction), 24));
      lowest = std::min(lowest, exponent - 24 + std::countr_zero(mantissa));
    });
    return lowest == std::numeric_limits<int>::max() ? 1 : std::ldexp(1.0, lowest);
  }

  /// Sixteen times the distance between neighbouring floats where they are largest. The last bits
  /// of a height are noise: coding them as corrections takes 1 to 2 % less than lifting them.
  double correctedStep() const {
    const double largest = std::max(std::abs(low_), std::abs(low_ + range_));
    return std::ldexp(16.0, spacingExponent(static_cast<float>(largest)));
  }

 private:
  bool isValid(size_t i) const { return valid_ == nullptr || valid_[i]; }
  template <class F>
  void forEachValid(const F& f) const {
    for (size_t i = 0; i < count_; ++i) {
      if (isValid(i)) f(i);
    }
  }
  int32_t quantise(const HeightSteps& s, size_t i) const {
    return static_cast<int32_t>(std::lround((static_cast<double>(samples_[i]) - s.base) / s.step));
  }

  const T* samples_;
  size_t count_;
  const uint8_t* valid_;
  double low_ = 0, range_ = 0;
};

double powerOfTwoBelow(double x) {
  return std::exp2(std::floor(std::log2(x)));
}

double lossyStep(double range, double error) {
  double step = powerOfTwoBelow(range / kLossySteps) * 2;
  if (error > 0) step = std::min(step, powerOfTwoBelow(error / 64));
  return std::max(step, powerOfTwoBelow(range / kMostSteps) * 2);
}

double chooseStep(const Stepper<float>& stepper, const StepNeeds& needs) {
  for (const double step : {1.0, 0.1, 0.01, 0.001}) {
    if (stepper.fits(step) && stepper.restores(step)) return step;
  }
  const double binary = stepper.commonPowerOfTwo();
  if (stepper.fits(binary) && stepper.restores(binary)) return binary;
  return needs.lossless ? stepper.correctedStep() : lossyStep(stepper.range(), needs.error);
}

template <class T>
double chooseStep(const Stepper<T>& stepper, const StepNeeds&) {
  double step = stepper.commonDivisor();
  while (!stepper.fits(step)) step *= 2;
  return step;
}

template <class T>
T voidSample(const GeometryLayers& layers) {
  if constexpr (std::is_floating_point_v<T>) {
    return layers.has_nodata ? static_cast<T>(layers.nodata) : std::numeric_limits<T>::quiet_NaN();
  } else {
    return restore<T>(layers.nodata, 0, 0);
  }
}

/// Whether T has the value that is declared for voids. If not no sample can be taken for one.
template <class T>
bool holdsNodata(const GeometryLayers& layers) {
  if (layers.has_nodata == 0) return false;
  return std::is_floating_point_v<T> || static_cast<double>(voidSample<T>(layers)) == layers.nodata;
}

/// What a height becomes that came out as the value of voids: the next larger sample, beside the
/// largest finite one, or infinity, the next smaller. Both zeros have the same neighbour.
template <class T>
T besides(T nodata) {
  if (nodata >= std::numeric_limits<T>::max()) return fromOrder<T>(orderOf(nodata) - 1);
  return fromOrder<T>(orderOf(nodata == 0 ? T{0} : nodata) + 1);
}

/// Voids get their value, and no height keeps it.
template <class T>
void markVoids(const std::vector<uint8_t>& valid, const GeometryLayers& layers,
               std::span<T> samples) {
  const T nodata = voidSample<T>(layers);
  if (holdsNodata<T>(layers)) std::replace(samples.begin(), samples.end(), nodata, besides(nodata));
  for (size_t i = 0; i < valid.size(); ++i) {
    if (!valid[i]) samples[i] = nodata;
  }
}

}  // namespace

size_t HeightSteps::validCount() const {
  return valid.empty() ? steps.size()
                       : static_cast<size_t>(std::count(valid.begin(), valid.end(), uint8_t{1}));
}

Result<HeightSteps> toSteps(const tks_heights& heights, const StepNeeds& needs) {
  Result<std::vector<uint8_t>> valid = findVoids(heights);
  if (!valid.ok()) return valid.status();
  Result<HeightSteps> result =
      withSampleType(heights.sample, [&](auto type) -> Result<HeightSteps> {
        using T = decltype(type);
        const Stepper<T> stepper(heights, *valid);
        const bool chosen = needs.given <= 0;
        if (std::is_floating_point_v<T> && chosen && stepper.range() == 0) return stepper.flat();
        const double step = chosen ? chooseStep(stepper, needs) : needs.given;
        if (stepper.fits(step)) return stepper.with(step);
        return Status(TKS_USAGE, "A step of " + std::to_string(step) +
                                     " divides the range of the heights into more than 2^26 "
                                     "parts; give a larger one.");
      });
  if (result.ok()) result->valid = std::move(*valid);
  return result;
}

void fromSteps(const DecodedHeights& decoded, const GeometryHeader& header,
               const GeometryLayers& layers, void* out) {
  const DecodedGeometry& geometry = decoded.geometry;
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    using T = decltype(type);
    T* samples = static_cast<T*>(out);
    restoreAll(geometry, header, samples);
    for (size_t i = 0; i < decoded.corrections.size(); ++i) {
      const auto correction = static_cast<uint32_t>(decoded.corrections[i]);
      samples[i] = fromOrder<T>(orderOf(samples[i]) + correction);
    }
    markVoids(geometry.valid, layers, std::span(samples, geometry.heights.size()));
  });
}

std::vector<uint8_t> sampleHints(const std::vector<int32_t>& steps, const GeometryHeader& header) {
  std::vector<uint8_t> hints(steps.size());
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    using T = decltype(type);
    for (size_t i = 0; i < steps.size(); ++i)
      hints[i] = openBits(restore<T>(header.base, header.step, steps[i]), header.step);
  });
  return hints;
}

std::vector<int32_t> sampleCorrections(const tks_heights& heights, const HeightSteps& steps) {
  std::vector<int32_t> corrections(steps.steps.size(), 0);
  withSampleType(heights.sample, [&](auto type) {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(heights.data);
    for (size_t i = 0; i < corrections.size(); ++i) {
      if (!steps.valid.empty() && !steps.valid[i]) continue;
      const T restored = restore<T>(steps.base, steps.step, steps.steps[i]);
      corrections[i] = static_cast<int32_t>(orderOf(samples[i]) - orderOf(restored));
    }
  });
  return corrections;
}

StepErrors errorsOf(const tks_heights& heights, const HeightSteps& steps) {
  return withSampleType(heights.sample, [&](auto type) {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(heights.data);
    StepErrors errors;
    for (size_t i = 0; i < steps.steps.size(); ++i) {
      if (!steps.valid.empty() && !steps.valid[i]) continue;
      const double error =
          std::abs(static_cast<double>(restore<T>(steps.base, steps.step, steps.steps[i])) -
                   static_cast<double>(samples[i]));
      errors.largest = std::max(errors.largest, error);
      errors.squares += error * error;
    }
    return errors;
  });
}

}  // namespace tetrakis
