// SPDX-License-Identifier: Apache-2.0
#include "encoder/targets/other_exact_heights.hpp"

#include <algorithm>
#include <limits>

#include "codec/geometry/drawn_heights/drawing_estimate.hpp"
#include "encoder/heights/ways/exact_heights.hpp"
#include "encoder/targets/component_curves.hpp"

namespace tetrakis::inline targets {

std::optional<HeightsCandidate> fewValues(const EncodeInputs& inputs,
                                          const HeightsCandidate& lossy) {
  constexpr double kGenerous = 2. / 8;  // bytes a sample; smaller budgets hold no table
  constexpr double kAnyError = std::numeric_limits<double>::infinity();
  if (!lossy.coded) return {};
  const uint64_t room = std::min(inputs.options.bytes, lossy.bytes());
  const QuantisedHeights& quantised = *lossy.coded->quantised;
  const bool few = drawingMayFit(
      {quantised.steps.steps, extentOf(*quantised.samples), quantised.steps.valid}, room);
  const bool generous =
      static_cast<double>(inputs.options.bytes) >= kGenerous * lossy.coded->counted();
  if (!few && !generous) return {};
  HeightsCandidate exact = {exactHeightsFor(inputs, kAnyError, room)};
  if (!exact.coded) return {};
  const bool shapes = exact.coded->header.drawn || (few && exact.coded->hasCorrections());
  if (!shapes && exact.coded->layers.table_bytes == 0) return {};
  if (shapes ? exact.bytes() > room : 2 * exact.bytes() > inputs.options.bytes) return {};
  exact.curve = curveOfHeights(inputs, *exact.coded);
  return exact;
}

HeightsCandidate shortExactHeights(const EncodeInputs& inputs) {
  constexpr double kClearly = 0.8;
  const auto room = static_cast<uint64_t>(kClearly * static_cast<double>(inputs.options.bytes));
  HeightsCandidate exact = {exactHeightsFor(inputs, 0, room)};
  if (!exact.coded || exact.bytes() > room) return {};
  return exact;
}

}  // namespace tetrakis::inline targets
