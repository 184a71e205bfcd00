// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/other_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/status.hpp"
#include "codec/geometry/quantiser/exact_bits.hpp"
#include "codec/geometry/quantiser/step_choice.hpp"

namespace tetrakis::inline quantiser {

namespace {

/// Samples that are examined for multiples of a step. More of them tell the share more exactly, and
/// take time.
constexpr size_t kLookedAt = 1 << 16;
/// The steps that are tried beside the step found, if they are kCoarser times as coarse, and if
/// some samples are multiples of them. More trials save bytes of files of two sources, and take
/// time.
constexpr std::array<double, 3> kOtherSteps = {1.0, 0.1, 0.01};
constexpr double kCoarser = 4, kSome = 1. / 8;
/// The finer step that is tried where no step shows all samples, over the step found. A part of 32
/// saves 3 to 7 % more bytes of triangulated terrain; prefixes then take more bits.
constexpr double kFiner = 1. / 16;
/// Other steps have to take this share of the bits: estimates err by as much. A larger share saves
/// bytes of some files, and loses bytes of others.
constexpr double kClearlyFewer = 0.96;

/// The share of multiples among the samples that differ from the one before. Flat ground says
/// nothing about steps.
double shareOfMultiples(const tks_heights& heights, const HeightSteps& found, double step) {
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
  if (heights.sample != TKS_F32) return found;
  std::optional<HeightSteps> better;
  double least = -1;
  const auto tryStep = [&](double step) {
    Result<HeightSteps> other = toSteps(heights, {.given = step});
    if (!other.ok()) return;
    if (least < 0) least = kClearlyFewer * exactBits(heights, found);
    const double bits = exactBits(heights, *other);
    if (bits >= least) return;
    least = bits;
    better = std::move(*other);
  };
  if (!found.exact) tryStep(kFiner * found.step);
  for (const double step : kOtherSteps) {
    if (step >= kCoarser * found.step && shareOfMultiples(heights, found, step) >= kSome)
      tryStep(step);
  }
  return better ? *std::move(better) : std::move(found);
}

}  // namespace tetrakis::inline quantiser
