// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/height_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "base/samples.hpp"
#include "codec/geometry/integer_scale.hpp"
#include "codec/geometry/restore.hpp"
#include "codec/geometry/sample_order.hpp"

namespace tetrakis::inline geometry {

namespace {

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

/// Some samples, corrections included.
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

/// Of samples that are restored a few at a time, so that nobody needs room for all of them.
/// restoreSome(first, samples): writes those from `first` on.
template <class T, class RestoreSome>
StepErrors errorsOf(const tks_heights& heights, Mask valid, const SquareSum& sum,
                    const RestoreSome& restoreSome) {
  const auto* truth = static_cast<const T*>(heights.data);
  const size_t count = size_t{heights.width} * heights.height;
  std::array<T, 4096> restored;
  StepErrors errors;
  for (size_t first = 0; first < count; first += restored.size()) {
    const size_t some = std::min(restored.size(), count - first);
    restoreSome(first, std::span(restored).first(some));
    for (size_t i = 0; i < some; ++i) {
      if (!valid[first + i]) continue;
      const double error =
          std::abs(static_cast<double>(restored[i]) - static_cast<double>(truth[first + i]));
      errors.largest = std::max(errors.largest, error);
      errors.squares += sum.of(first + i, error);
    }
  }
  return errors;
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

void fromSteps(const DecodedHeights& decoded, const GeometryHeader& header,
               const GeometryLayers& layers, void* out) {
  const DecodedGeometry& geometry = decoded.geometry;
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    using T = decltype(type);
    const std::span<T> samples(static_cast<T*>(out), geometry.heights.size());
    restoreCorrected(decoded, 0, {header.base, header.step}, samples);
    markVoids(geometry.valid, layers, samples);
  });
}

std::vector<int32_t> drawnSteps(const HeightSteps& steps, const GeometryHeader& header) {
  if (steps.table.empty()) return steps.steps;
  const std::vector<DrawnValue> values = drawnValues(steps.table, header);
  std::vector<int32_t> drawn(steps.steps.size(), 0);
  for (size_t i = 0; i < drawn.size(); ++i) {
    if (!steps.valid.empty() && !steps.valid[i]) continue;
    drawn[i] =
        wholeStep(values[steps.table.placeOf(steps.steps[i])].height, DrawnValue::kFractionBits);
  }
  return drawn;
}

std::vector<uint8_t> sampleHints(std::span<const int32_t> heights, int fraction_bits,
                                 const GeometryHeader& header) {
  std::vector<uint8_t> hints(heights.size());
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    using T = decltype(type);
    for (size_t i = 0; i < heights.size(); ++i) {
      const int32_t q = wholeStep(heights[i], fraction_bits);
      hints[i] = openBits(restore<T>(header.base, header.step, q), header.step);
    }
  });
  return hints;
}

std::vector<int32_t> sampleCorrections(const tks_heights& heights, const HeightSteps& steps) {
  std::vector<int32_t> corrections(steps.steps.size(), 0);
  withSampleType(heights.sample, [&](auto type) {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(heights.data);
    const Mask valid = steps.valid;
    for (size_t i = 0; i < corrections.size(); ++i) {
      if (!valid[i]) continue;
      const uint32_t restored = steps.table.empty()
                                    ? orderOf(restore<T>(steps.base, steps.step, steps.steps[i]))
                                    : steps.table.wordOf(steps.steps[i]);
      corrections[i] = static_cast<int32_t>(orderOf(samples[i]) - restored);
    }
  });
  return corrections;
}

StepErrors errorsOf(const tks_heights& heights, const HeightSteps& steps, const SquareSum& sum) {
  return withSampleType(heights.sample, [&](auto type) {
    using T = decltype(type);
    return errorsOf<T>(heights, steps.valid, sum, [&](size_t first, std::span<T> samples) {
      const auto some = std::span(steps.steps).subspan(first, samples.size());
      if (steps.table.empty()) return restoreAll(some, 0, {steps.base, steps.step}, samples.data());
      std::transform(some.begin(), some.end(), samples.begin(),
                     [&](int32_t q) { return fromOrder<T>(steps.table.wordOf(q)); });
    });
  });
}

double squaresOfSamples(const tks_heights& truth, const DecodedHeights& decoded,
                        const std::vector<uint8_t>& valid, const HeightSteps& scale,
                        const SquareSum& sum) {
  return withSampleType(truth.sample, [&](auto type) {
    using T = decltype(type);
    const auto restoreSome = [&](size_t first, std::span<T> samples) {
      restoreCorrected(decoded, first, {scale.base, scale.step}, samples);
    };
    return errorsOf<T>(truth, valid, sum, restoreSome).squares;
  });
}

}  // namespace tetrakis::inline geometry
