// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/step_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/samples.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline quantiser {

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

}  // namespace tetrakis::inline quantiser
