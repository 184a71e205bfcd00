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

/// Bytes a sample from which on a budget may hold heights in a table. With a smaller number more
/// tables are tried in vain; a larger one misses heights of few values.
constexpr double kGenerous = 2. / 8;
/// The share of exact heights of few values that a budget has to hold for them to be tried. A
/// smaller share tries more of them, which takes time, and ends more streams before they are exact.
constexpr double kLargePart = 0.7;
/// Budgets above this many times the bytes of heights in a table end with the table. A smaller
/// number saves bytes of more streams, and costs their prefixes quality.
constexpr uint64_t kRoomOfHeightTable = 2;
/// The share of a budget that exact heights may take to be taken for it. A larger share ends more
/// streams exact, and leaves the prefixes of these streams less for lossy coefficients.
constexpr double kClearlyShort = 0.8;

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
  exact.fit = shapes ? bytes <= room : kRoomOfHeightTable * bytes <= inputs.options.bytes;
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
  const auto room =
      static_cast<uint64_t>(kClearlyShort * static_cast<double>(inputs.options.bytes));
  HeightsCandidate exact = few;
  if (!few.coded && mayBeShort(inputs, lossy, room)) exact = {exactHeightsFor(inputs, 0, room)};
  if (!areWithin(inputs, exact, room)) return {};
  return exact;
}

}  // namespace tetrakis::inline targets
