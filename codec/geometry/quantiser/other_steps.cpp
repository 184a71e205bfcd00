// SPDX-License-Identifier: Apache-2.0
// fewerBitsByOtherSteps() tries steps that show only some of the samples, nearGrid() finds steps
// that nearly show all, and bitsOfSteps() and exactBits() estimate the bits that heights take with
// them.
#include "codec/geometry/quantiser/step_choice.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "codec/wavelet/choice/filter_choice.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline quantiser {

double bitsOfSteps(const tks_heights& heights, const HeightSteps& steps) {
  return losslessBits({steps.steps, {heights.width, heights.height}, steps.valid},
                      steps.range_bits);
}

double exactBits(const tks_heights& heights, const HeightSteps& steps) {
  const double bits = bitsOfSteps(heights, steps);
  if (steps.exact) return bits;
  Exceptions exceptions;
  for (const int32_t correction : sampleCorrections(heights, steps)) {
    if (correction != 0) exceptions.add(static_cast<uint32_t>(correction), 1);
  }
  return bits + exceptions.bits(steps.validCount());
}

namespace {

/// The grids that floats may lie near, from the widest on; 0.3048 are feet in metres. More of them
/// take the time of a pass over the samples each, until a sample does not suit.
constexpr std::array kGridUnits = {10., 1., 0.3048, 0.1, 0.01};

}  // namespace

std::optional<double> nearGrid(const tks_heights& heights, Mask valid, double error) {
  assert(heights.sample == TKS_F32);
  const size_t count = size_t{heights.width} * heights.height;
  const std::span samples(static_cast<const float*>(heights.data), count);
  const auto suits = [&](double unit) {
    for (size_t i = 0; i < count; ++i) {
      const auto sample = static_cast<double>(samples[i]);
      if (valid[i] && !(std::abs(sample - unit * std::round(sample / unit)) <= error)) return false;
    }
    return true;
  };
  const auto unit = std::find_if(kGridUnits.begin(), kGridUnits.end(),
                                 [&](double wide) { return wide > 2 * error && suits(wide); });
  return unit == kGridUnits.end() ? std::nullopt : std::optional(*unit);
}

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
