// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/height_steps.hpp"

#include <algorithm>

#include "base/samples.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline quantiser {

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

}  // namespace tetrakis::inline quantiser
