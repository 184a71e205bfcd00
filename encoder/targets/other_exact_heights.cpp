// SPDX-License-Identifier: Apache-2.0
#include "encoder/targets/other_exact_heights.hpp"

#include <algorithm>
#include <limits>

#include "codec/geometry/drawn_heights/drawn_heights_estimate.hpp"
#include "encoder/heights/height_errors.hpp"
#include "encoder/heights/heights_notes.hpp"
#include "encoder/heights/ways/exact_heights.hpp"
#include "encoder/targets/component_curves.hpp"

namespace tetrakis::inline targets {

namespace {

constexpr double kGenerous = 2. / 8;  // bytes a sample; smaller budgets hold no table

bool isGenerous(const EncodeInputs& inputs, const CodedHeights& heights) {
  return static_cast<double>(inputs.options.bytes) >= kGenerous * heights.counted();
}

/// Whether exact heights may fit the room, as far as one can tell without another look at all
/// samples.
bool mayBeShort(const EncodeInputs& inputs, const HeightsCandidate& lossy, uint64_t room) {
  const HeightSteps& steps = lossy.coded->quantised->steps;
  if (!steps.exact) return isGenerous(inputs, *lossy.coded) || lossy.bytes() < room;
  return mayTakeNoMore(inputs, *lossy.coded->quantised, room);
}

/// Whether there are such heights, in at most so many bytes. They are noted: what has room may yet
/// turn out worse than the lossy heights.
bool areWithin(const EncodeInputs& inputs, const HeightsCandidate& exact, uint64_t most) {
  if (!exact.coded) return false;
  const bool within = exact.bytes() <= most;
  note(inputs, *exact.coded, within ? Verdict::kWorseInBudget : Verdict::kNoRoom);
  return within;
}

}  // namespace

FewValues fewValues(const EncodeInputs& inputs, const HeightsCandidate& lossy) {
  constexpr double kAnyError = std::numeric_limits<double>::infinity();
  constexpr double kLargePart = 0.7;
  if (!lossy.coded) return {};
  const auto budget = static_cast<double>(inputs.options.bytes);
  const uint64_t room = std::min(inputs.options.bytes, lossy.bytes());
  const auto most = static_cast<uint64_t>(budget / kLargePart);
  const QuantisedHeights& quantised = *lossy.coded->quantised;
  const bool few = drawingMayFit(
      {quantised.steps.steps, extentOf(*quantised.samples), quantised.steps.valid}, most);
  if (!few && !isGenerous(inputs, *lossy.coded)) return {};
  FewValues exact{{exactHeightsFor(inputs, kAnyError, most)}};
  if (!areWithin(inputs, exact.heights, most)) return {};
  const CodedHeights& coded = *exact.heights.coded;
  const bool shapes = coded.header.drawn || (few && coded.hasCorrections());
  if (!shapes && coded.layers.table_bytes == 0) return {};
  const uint64_t bytes = exact.heights.bytes();
  exact.fit = shapes ? bytes <= room : 2 * bytes <= inputs.options.bytes;
  exact.heights.curve = curveOfHeights(inputs, coded);
  return exact;
}

bool isNearer(const EncodeInputs& inputs, const HeightsCandidate& exact,
              const HeightsCandidate& lossy, uint64_t room) {
  const auto error_of = [&](const HeightsCandidate& heights) {
    const std::vector<Packet>& packets = heights.curve->packets;
    const Codewords prefix =
        prefixAfter(heights.coded->accounted(), packets, std::min(room, payloadOf(packets)));
    return sampleErrorsOf(*heights.coded, prefix, inputs.options.threads).mean_square;
  };
  return error_of(exact) < error_of(lossy);
}

HeightsCandidate shortExactHeights(const EncodeInputs& inputs, const HeightsCandidate& lossy,
                                   const HeightsCandidate& few) {
  constexpr double kClearly = 0.8;
  const auto room = static_cast<uint64_t>(kClearly * static_cast<double>(inputs.options.bytes));
  HeightsCandidate exact = few;
  if (!few.coded && mayBeShort(inputs, lossy, room)) exact = {exactHeightsFor(inputs, 0, room)};
  if (!areWithin(inputs, exact, room)) return {};
  return exact;
}

}  // namespace tetrakis::inline targets
