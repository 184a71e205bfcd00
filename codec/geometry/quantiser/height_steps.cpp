// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/height_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "base/samples.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/wavelet/choice/bridge_choice.hpp"
#include "codec/wavelet/morphology.hpp"

namespace tetrakis::inline quantiser {

namespace {

Status notFinite(const tks_heights& heights, size_t i) {
  return {TKS_USAGE, "The height in column " + std::to_string(i % heights.width) + ", row " +
                         std::to_string(i / heights.width) +
                         " is infinite; declare it as nodata or fill it before encoding."};
}

}  // namespace

Result<std::vector<uint8_t>> findVoids(const tks_heights& heights) {
  const size_t count = size_t{heights.width} * heights.height;
  return withSampleType(heights.sample, [&](auto type) -> Result<std::vector<uint8_t>> {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(heights.data);
    const double nodata = std::is_floating_point_v<T>
                              ? static_cast<double>(static_cast<float>(heights.nodata))
                              : heights.nodata;
    std::vector<uint8_t> valid;  // takes no memory before the first void
    for (size_t i = 0; i < count; ++i) {
      const auto value = static_cast<double>(samples[i]);
      if (std::isnan(value) || (heights.has_nodata && value == nodata)) {
        if (valid.empty()) valid.assign(count, 1);
        valid[i] = 0;
      } else if (std::isinf(value)) {
        return notFinite(heights, i);
      }
    }
    return valid;
  });
}

SampleRange rangeOf(const tks_heights& heights, Mask valid) {
  return withSampleType(heights.sample, [&](auto type) {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(heights.data);
    SampleRange range;
    bool any = false;
    for (size_t i = 0; i < size_t{heights.width} * heights.height; ++i) {
      if (!valid[i]) continue;
      const auto value = static_cast<double>(samples[i]);
      range.low = any ? std::min(range.low, value) : value;
      range.high = any ? std::max(range.high, value) : value;
      any = true;
    }
    return range;
  });
}

namespace {

size_t marked(const std::vector<uint8_t>& mask, size_t samples) {
  if (mask.empty()) return samples;
  return static_cast<size_t>(std::count(mask.begin(), mask.end(), uint8_t{1}));
}

}  // namespace

size_t HeightSteps::validCount() const {
  return marked(valid, steps.size());
}

size_t HeightSteps::liftedCount() const {
  return marked(bridge == 0 ? valid : lifted, steps.size());
}

double HeightSteps::liftedShare() const {
  if (bridge == 0) return 1;
  return static_cast<double>(validCount()) /
         static_cast<double>(std::max<size_t>(liftedCount(), 1));
}

std::vector<int32_t> decodedSteps(const HeightSteps& steps, const GeometryHeader& header) {
  if (steps.table.empty()) return steps.steps;
  const std::vector<ValueInSteps> values = valuesInSteps(steps.table, header);
  std::vector<int32_t> decoded(steps.steps.size(), 0);
  for (size_t i = 0; i < decoded.size(); ++i) {
    if (!steps.valid.empty() && !steps.valid[i]) continue;
    decoded[i] = wholeStep(values[steps.table.placeOf(steps.steps[i])].height, kTableFractionBits);
  }
  return decoded;
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

namespace {

/// Compares restored samples with the true ones, a block at a time, so that no caller needs memory
/// for all of them. restore_some(first, samples): writes the samples from `first` on.
template <class T, class RestoreSome>
StepErrors errorsOf(const tks_heights& heights, Mask valid, const SquareSum& sum,
                    const RestoreSome& restore_some) {
  const auto* truth = static_cast<const T*>(heights.data);
  const size_t count = extentOf(heights).samples();
  std::array<T, 4096> restored;
  StepErrors errors;
  for (size_t first = 0; first < count; first += restored.size()) {
    const size_t some = std::min(restored.size(), count - first);
    restore_some(first, std::span(restored).first(some));
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

}  // namespace

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
    const auto restore_some = [&](size_t first, std::span<T> samples) {
      restoreCorrected(decoded, first, {scale.base, scale.step}, samples);
    };
    return errorsOf<T>(truth, valid, sum, restore_some).squares;
  });
}

HeightSteps withBridges(HeightSteps steps, Extent plane, uint8_t reach) {
  steps.bridge = reach;
  steps.lifted.clear();
  if (reach == 0) return steps;
  steps.lifted = liftedSamples(steps.valid, plane, reach);
  steps.steps = bridged({steps.steps, plane, steps.valid}, steps.lifted);
  return steps;
}

HeightSteps withBridgesFor(const BridgeTarget& target, HeightSteps steps, Extent plane) {
  if (steps.valid.empty()) return steps;
  BridgedPlane bridged = chooseBridges({steps.steps, plane, steps.valid}, steps.range_bits, target);
  if (bridged.reach == 0) return steps;
  steps.bridge = bridged.reach;
  steps.lifted = std::move(bridged.lifted);
  steps.steps = std::move(bridged.values);
  return steps;
}

}  // namespace tetrakis::inline quantiser
