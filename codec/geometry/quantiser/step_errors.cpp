// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/step_errors.hpp"

#include <algorithm>
#include <cmath>

#include "base/samples.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline quantiser {

StepErrors errorsOf(const tks_heights& heights, const HeightSteps& steps, const SquareSum& sum) {
  return withSampleType(heights.sample, [&](auto type) {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(heights.data);
    std::vector<T> restored(steps.steps.size());
    if (steps.table.empty()) {
      restoreAll(steps.steps, 0, {steps.base, steps.step}, restored.data());
    } else {
      std::transform(steps.steps.begin(), steps.steps.end(), restored.begin(),
                     [&](int32_t q) { return fromOrder<T>(steps.table.wordOf(q)); });
    }
    StepErrors errors;
    const Mask valid = steps.valid;
    for (size_t i = 0; i < restored.size(); ++i) {
      if (!valid[i]) continue;
      const double error =
          std::abs(static_cast<double>(restored[i]) - static_cast<double>(samples[i]));
      errors.largest = std::max(errors.largest, error);
      errors.squares += sum.of(i, error);
    }
    return errors;
  });
}

double squaresOfSamples(const tks_heights& truth, const DecodedHeights& decoded,
                        const std::vector<uint8_t>& valid, const HeightSteps& scale,
                        const SquareSum& sum) {
  const DecodedGeometry& geometry = decoded.geometry;
  return withSampleType(truth.sample, [&](auto type) {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(truth.data);
    double squares = 0;
    for (size_t i = 0; i < geometry.heights.size(); ++i) {
      if (!valid.empty() && !valid[i]) continue;
      const int32_t q = wholeStep(geometry.heights[i], geometry.fraction_bits);
      T restored = restore<T>(scale.base, scale.step, q);
      if (!decoded.corrections.empty()) {
        const auto correction = static_cast<uint32_t>(decoded.corrections[i]);
        restored = fromOrder<T>(orderOf(restored) + correction);
      }
      const double error = static_cast<double>(restored) - static_cast<double>(samples[i]);
      squares += sum.of(i, error);
    }
    return squares;
  });
}

}  // namespace tetrakis::inline quantiser
