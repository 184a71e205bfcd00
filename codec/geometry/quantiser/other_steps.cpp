// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/other_steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/status.hpp"
#include "codec/geometry/quantiser/exact_bits.hpp"
#include "codec/geometry/quantiser/step_choice.hpp"

namespace tetrakis::inline quantiser {

namespace {

/// The share of multiples among the samples that differ from the one before. Flat ground says
/// nothing about steps. Only some thousands of samples are examined.
double shareOfMultiples(const tks_heights& heights, const HeightSteps& found, double step) {
  constexpr size_t kLookedAt = 1 << 16;
  const auto* samples = static_cast<const float*>(heights.data);
  const size_t count = found.steps.size(), stride = std::max<size_t>(count / kLookedAt, 1) | 1;
  size_t multiples = 0, changes = 0;
  for (size_t i = 1; i < count; i += stride) {
    if ((!found.valid.empty() && !found.valid[i]) || samples[i] == samples[i - 1]) continue;
    const double nearest = std::round(static_cast<double>(samples[i]) / step) * step;
    multiples += static_cast<float>(nearest) == samples[i];
    ++changes;
  }
  return static_cast<double>(multiples) / static_cast<double>(std::max<size_t>(changes, 1));
}

}  // namespace

HeightSteps fewerBitsByOtherSteps(const tks_heights& heights, HeightSteps found) {
  constexpr double kCoarser = 4, kFiner = 1. / 16, kSome = 1. / 8, kClearly = 0.96;
  if (heights.sample != TKS_F32) return found;
  std::optional<HeightSteps> better;
  double least = -1;
  const auto tryStep = [&](double step) {
    Result<HeightSteps> other = toSteps(heights, {.given = step});
    if (!other.ok()) return;
    if (least < 0) least = kClearly * exactBits(heights, found);
    const double bits = exactBits(heights, *other);
    if (bits >= least) return;
    least = bits;
    better = std::move(*other);
  };
  if (!found.exact) tryStep(kFiner * found.step);
  for (const double step : {1.0, 0.1, 0.01}) {
    if (step >= kCoarser * found.step && shareOfMultiples(heights, found, step) >= kSome)
      tryStep(step);
  }
  return better ? *std::move(better) : std::move(found);
}

}  // namespace tetrakis::inline quantiser
