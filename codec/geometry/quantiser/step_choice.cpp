// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/step_choice.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <string>
#include <type_traits>

#include "base/portable_math.hpp"
#include "base/samples.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/geometry/quantiser/value_choice.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline quantiser {

namespace {

/// The step of a largest error is at most this part of it. A larger number takes bits that are cut
/// anyway; with a smaller one the rounding of samples takes more of the bound.
constexpr double kErrorPart = 64;

/// One in this number of samples may be an exception, which the step of all others does not
/// restore. A smaller number gives more files coarse steps, and their exceptions take bytes.
constexpr size_t kExceptionsIn = 256;
/// Outliers lie this many times as far off as all other samples are apart. A smaller number leaves
/// more samples to corrections; a larger one makes the step of all samples coarser.
constexpr double kFarOutlier = 1 << 20;
/// The base is the mean where that lies this share of the range off the middle, and where steps are
/// fewer than kFewSteps. A smaller share shows first prefixes nearer heights, and takes bits.
constexpr double kFarMean = 0.25, kFewSteps = 1 << 24;
/// Distances of floats in the step of floats that have no other step. Coding the last bits as
/// corrections takes 1 to 2 % less than lifting them; more of them make prefixes coarser.
constexpr double kFloatsInStep = 16;
/// A step with exceptions has to be this many times as coarse as the exact one. A smaller factor
/// takes corrections for steps that hardly gain.
constexpr double kWorthCoarser = 2;

template <class T>
bool same(T a, T b) {
  return orderOf(a) == orderOf(b);
}

/// The valid samples, their range, and the middle of the steps. Samples outside of the range are
/// exceptions: their step is the nearest end of it.
template <class T>
class Stepper {
 public:
  Stepper(const tks_heights& heights, Mask valid)
      : samples_(static_cast<const T*>(heights.data)),
        count_(size_t{heights.width} * heights.height),
        valid_(valid) {
    setRange(rangeOf(heights, valid));
  }

  double range() const { return range_; }
  bool fits(double step) const { return range_ / step < kMostSteps; }

  /// Leaves a few samples out of the range that are so far from all others that 2^26 steps cannot
  /// show both. Undeclared voids are examples: a 3.4e38 among heights of metres.
  void leaveOutliers() {
    std::vector<T> sorted;
    forEachValid([&](size_t i) { sorted.push_back(samples_[i]); });
    const size_t few = sorted.size() / (2 * kExceptionsIn);
    if (few == 0) return;
    const auto low = sorted.begin() + static_cast<ptrdiff_t>(few),
               high = sorted.end() - 1 - static_cast<ptrdiff_t>(few);
    std::nth_element(sorted.begin(), low, sorted.end());
    std::nth_element(low, high, sorted.end());
    const double middle = static_cast<double>(*low), width = static_cast<double>(*high) - middle;
    if (!(range_ > kFarOutlier * width) || width == 0) return;
    SampleRange core = {middle, middle};
    for (const T sample : sorted) {
      const auto value = static_cast<double>(sample);
      if (std::abs(value - middle) > kFarOutlier * width / 2) continue;
      core.low = std::min(core.low, value);
      core.high = std::max(core.high, value);
    }
    assert(core.low >= low_ && core.high <= high_);
    setRange(core);
  }

  /// How far the base lies above the lowest sample. Decoders show the base until they know more. So
  /// the base is the mean where the mean is far from the middle of the range, as on open ground
  /// among trees; elsewhere it is the middle, where steps take the fewest bits.
  double typicalAbove(double step) const {
    double sum = 0, count = 0;
    for (size_t i = 0; i < count_; ++i) {
      if (!isInRange(i)) continue;
      sum += static_cast<double>(samples_[i]) - low_;
      ++count;
    }
    const double middle = range_ / 2, mean = count > 0 ? sum / count : middle;
    return std::abs(mean - middle) > kFarMean * range_ && range_ / step < kFewSteps ? mean : middle;
  }

  HeightSteps with(double step) const {
    assert(step > 0);
    HeightSteps out;
    out.step = step;
    out.base = low_ + step * std::floor(typicalAbove(step) / step);
    if constexpr (std::is_floating_point_v<T>) out.base = step * std::round(out.base / step);
    out.steps.resize(count_);
    out.exact = true;
    if (std::is_integral_v<T> && step == 1) {
      takeWhole(out);
    } else {
      forEachValid([&](size_t i) {
        out.steps[i] = quantise(out, i);
        out.exact &= same(restore<T>(out.base, step, out.steps[i]), samples_[i]);
      });
    }
    out.range_bits =
        std::bit_width(static_cast<uint32_t>(std::min(range_ / step, kMostSteps)) + 1u);
    return out;
  }

  /// The steps of samples that all have one value, the base; or of no samples.
  HeightSteps flat() const {
    HeightSteps out;
    out.steps.assign(count_, 0);
    out.base = low_;
    out.exact = true;
    const T value = restore<T>(out.base, out.step, 0);
    forEachValid([&](size_t i) { out.exact &= same(value, samples_[i]); });
    return out;
  }

  /// Whether `step` restores the values of all samples in the range except at most `exceptions`.
  /// The sign of a zero does not count: a correction restores it where every bit counts.
  bool restores(double step, size_t exceptions) const {
    HeightSteps trial;
    trial.step = step;
    trial.base = step * std::round((low_ + range_ / 2) / step);
    size_t missed = 0;
    for (size_t i = 0; i < count_ && missed <= exceptions; ++i)
      missed += isInRange(i) && restore<T>(trial.base, step, quantise(trial, i)) != samples_[i];
    return missed <= exceptions;
  }

  /// How many exceptions are allowed: a share of the samples that differ from the one before. Flat
  /// ground says nothing about steps.
  size_t few() const {
    size_t changes = 0;
    for (size_t i = 1; i < count_; ++i) changes += isInRange(i) && samples_[i] != samples_[i - 1];
    return changes / kExceptionsIn;
  }

  /// Greatest common divisor of the differences between integer samples.
  double commonDivisor() const {
    uint64_t divisor = 0;
    for (size_t i = 0; i < count_ && divisor != 1; ++i) {
      if (!valid_[i]) continue;
      divisor = std::gcd(divisor, static_cast<uint64_t>(static_cast<double>(samples_[i]) - low_));
    }
    return divisor == 0 ? 1 : static_cast<double>(divisor);
  }

  /// The greatest common divisor of all floats in the range, in a unit of which they may be
  /// multiples: 5 for heights in fives of metres. 1 if there is none.
  double commonMultiple(double unit) const {
    constexpr double kExact = 0x1p53;
    uint64_t divisor = 0;
    for (size_t i = 0; i < count_ && divisor != 1; ++i) {
      if (!isInRange(i)) continue;
      const double units = std::round(std::abs(static_cast<double>(samples_[i])) / unit);
      if (units >= kExact) return 1;
      divisor = std::gcd(divisor, static_cast<uint64_t>(units));
    }
    return divisor == 0 ? 1 : static_cast<double>(divisor);
  }

  /// The largest power of two that divides every float in the range except at most `exceptions`; 1
  /// if all are 0.
  double commonPowerOfTwo(size_t exceptions) const {
    constexpr int kLeast = -149, kMost = 127;  // exponents of the lowest bit of a float
    std::array<size_t, kMost - kLeast + 1> lowest_bits{};
    forEachValid([&](size_t i) {
      if (samples_[i] == 0 || !isInRange(i)) return;
      int exponent = 0;
      const double fraction = std::frexp(static_cast<double>(samples_[i]), &exponent);
      const auto mantissa = static_cast<uint32_t>(std::ldexp(std::abs(fraction), 24));
      ++lowest_bits[static_cast<size_t>(exponent - 24 + std::countr_zero(mantissa) - kLeast)];
    });
    size_t finer = 0;
    for (size_t i = 0; i < lowest_bits.size(); ++i) {
      finer += lowest_bits[i];
      if (finer > exceptions) return std::ldexp(1.0, static_cast<int>(i) + kLeast);
    }
    return 1;
  }

  /// A multiple of the distance between neighbouring floats where they are largest: the last bits
  /// of a height are noise.
  double correctedStep() const {
    const double largest = std::max(std::abs(low_), std::abs(high_));
    return std::ldexp(kFloatsInStep, spacingExponent(static_cast<float>(largest)));
  }

 private:
  void setRange(const SampleRange& range) {
    low_ = range.low;
    high_ = range.high;
    range_ = high_ - low_;
  }
  bool isInRange(size_t i) const {
    const auto value = static_cast<double>(samples_[i]);
    return valid_[i] && value >= low_ && value <= high_;
  }
  template <class F>
  void forEachValid(const F& f) const {
    for (size_t i = 0; i < count_; ++i) {
      if (valid_[i]) f(i);
    }
  }
  double inside(size_t i) const {
    return std::clamp(static_cast<double>(samples_[i]), low_, high_);
  }
  /// Whole samples in steps of 1, whose base is whole too: nothing has to be rounded.
  void takeWhole(HeightSteps& out) const {
    forEachValid([&](size_t i) {
      const double sample = inside(i);
      out.steps[i] = static_cast<int32_t>(sample - out.base);
      out.exact &= sample == static_cast<double>(samples_[i]);
    });
  }
  int32_t quantise(const HeightSteps& s, size_t i) const {
    return static_cast<int32_t>(std::lround((inside(i) - s.base) / s.step));
  }

  const T* samples_;
  size_t count_;
  Mask valid_;
  double low_ = 0, high_ = 0, range_ = 0;
};

double powerOfTwoBelow(double x) {
  return portable::exp2(std::floor(portable::log2(x)));
}

double lossyStep(double range, double error) {
  double step = powerOfTwoBelow(range / kLossySteps) * 2;
  if (error > 0) step = std::min(step, powerOfTwoBelow(error / kErrorPart));
  return std::max(step, powerOfTwoBelow(range / kMostSteps) * 2);
}

/// The coarsest step that restores all samples except at most `exceptions`.
std::optional<double> restoringStep(const Stepper<float>& stepper, size_t exceptions) {
  for (const double unit : kDecimalSteps) {
    const double step = exceptions == 0 ? unit * stepper.commonMultiple(unit) : unit;
    if (stepper.fits(step) && stepper.restores(step, exceptions)) return step;
  }
  const double binary = stepper.commonPowerOfTwo(exceptions);
  if (stepper.fits(binary) && stepper.restores(binary, exceptions)) return binary;
  return {};
}

/// The step of almost all samples, where it pays: a few exceptions must not make the step of all
/// samples finer.
std::optional<double> tolerantStep(const Stepper<float>& stepper, std::optional<double> exact) {
  const size_t few = stepper.few();
  const auto step = few > 0 ? restoringStep(stepper, few) : std::nullopt;
  // The step gains nothing if it is hardly coarser than the exact one or, without an exact one,
  // finer than correctedStep().
  if (!step || *step < (exact ? kWorthCoarser * *exact : stepper.correctedStep())) return exact;
  return step;
}

double chooseStep(Stepper<float>& stepper, const StepNeeds& needs) {
  std::optional<double> step = restoringStep(stepper, 0);
  if (!step && (needs.lossless || needs.leave_outliers)) {
    stepper.leaveOutliers();
    step = restoringStep(stepper, 0);
  }
  if (needs.lossless) step = tolerantStep(stepper, step);
  if (step) return *step;
  return needs.lossless ? stepper.correctedStep() : lossyStep(stepper.range(), needs.error);
}

template <class T>
double chooseStep(Stepper<T>& stepper, const StepNeeds&) {
  double step = stepper.commonDivisor();
  while (!stepper.fits(step)) step *= 2;
  return step;
}

/// Writes six digits, because a step may be tiny.
std::string decimal(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

}  // namespace

Result<HeightSteps> toSteps(const tks_heights& heights, const StepNeeds& needs) {
  Result<std::vector<uint8_t>> valid = findVoids(heights);
  if (!valid.ok()) return valid.status();
  Result<HeightSteps> result =
      withSampleType(heights.sample, [&](auto type) -> Result<HeightSteps> {
        using T = decltype(type);
        Stepper<T> stepper(heights, *valid);
        const bool chosen = needs.given <= 0;
        if (std::is_floating_point_v<T> && chosen && stepper.range() == 0) return stepper.flat();
        const double step = chosen ? chooseStep(stepper, needs) : needs.given;
        if (stepper.fits(step)) return stepper.with(step);
        return Status(TKS_USAGE, "A step of " + decimal(step) +
                                     " divides the range of the heights into more than 2^26 "
                                     "parts; give a larger one.");
      });
  if (!result.ok()) return result;
  result->valid = std::move(*valid);
  if (!needs.lossless) return result;
  if (needs.given <= 0) *result = fewerBitsByOtherSteps(heights, std::move(*result));
  if (needs.table) *result = fewerBits(heights, std::move(*result));
  return result;
}

}  // namespace tetrakis::inline quantiser
