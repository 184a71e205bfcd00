// SPDX-License-Identifier: Apache-2.0
#include "encoder/targets/targets.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/portable_math.hpp"
#include "encoder/heights/ways/ways.hpp"
#include "encoder/selection/write_stream.hpp"
#include "encoder/views/pairs.hpp"
#include "ratecontrol/allocation/allocation.hpp"
#include "ratecontrol/needs/needs.hpp"

namespace tetrakis::inline targets {

namespace {

/// The parts of the budget whose pictures decide between exact and lossy streams. More of them take
/// the time of decoding and looking; smaller ones count for early prefixes.
constexpr std::array<double, 6> kPictureParts = {1. / 16, 1. / 8, 1. / 4, 1. / 2, 3. / 4, 1.};
/// The squared error of pictures, in parts of 255, that nobody can see: 60 dB. A larger number lets
/// fewer errors count against the prefixes of exact streams.
constexpr double kUnseen = 65025e-6;

/// Whether the last bit of each component is in reach of the budget, or the stream lacks the
/// component: the budget holds all of the component, or its error is nearly that of exact samples.
struct InReach {
  bool heights, texture;
};

InReach lastBitsInReach(const EncodeInputs& inputs, const Selection& selection,
                        const ByNeighbours& neighbours) {
  const auto rmse = statedWithin(selection.packets, inputs.options.bytes);
  const bool texture =
      !selection.texture || rmse[1] <= kNearlyExact * gapOfValues(*selection.texture);
  if (!selection.heights) return {true, texture};
  const CodedHeights& heights = *selection.heights;
  const bool all = bytesOfPackets(selection.packets) <= inputs.options.bytes;
  const double step = std::max(1., neighbours.relative_step / heights.quantised->steps.step);
  const bool near = rmse[0] <= kNearlyExact * step || neighbours.facets.has_value();
  return {near || (all && canBeRestored(heights)), texture};
}

/// All packets of the candidates, if they restore everything.
std::optional<Selection> selectIfLossless(const EncodeInputs& inputs, Candidates exact) {
  Selection selection = orderPackets(withCurves(inputs, std::move(exact)));
  Selection joined = selection;
  joined.packets = joinNeighbours(selection.packets);
  if (!isLossless(inputs, joined)) return {};
  return selection;
}

/// Exact heights whose shortest stream takes clearly fewer bytes than the budget.
std::optional<Selection> shortIfExact(const EncodeInputs& inputs, const HeightsCandidate& lossy,
                                      const HeightsCandidate& few) {
  HeightsCandidate heights = shortExactHeights(inputs, lossy, few);
  if (!heights.coded) return {};
  return selectIfLossless(inputs, {std::move(heights), {}});
}

/// A part of exact heights of few values, if this part is nearer to the samples than an equally
/// long part of the lossy heights.
std::optional<Selection> nearerPart(const EncodeInputs& inputs, const Candidates& lossy,
                                    const Selection& selection, const HeightsCandidate& few) {
  const uint64_t header = headerBytesOf(inputs, selection);
  if (!few.coded || header >= inputs.options.bytes) return {};
  if (!isNearer(inputs, few, lossy.heights, inputs.options.bytes - header)) return {};
  return orderPackets({few, {}});
}

/// The exact way that takes fewer bytes than the room; without one, the lossy component as it
/// stands if all of it fits: it may be exact as well, in more bytes.
template <class Coded>
std::optional<Candidate<Coded>> within(uint64_t room, std::optional<Candidate<Coded>> exact,
                                       const Candidate<Coded>& lossy) {
  if (exact && exact->bytes() < room) return exact;
  const bool whole = std::all_of(lossy.coded->tracks.begin(), lossy.coded->tracks.end(),
                                 [](const EncodedTrack& track) { return track.complete; });
  if (!whole || lossy.bytes() >= room) return {};
  return lossy;
}

/// Both components to the last bit, if they fit the budget together and their prefixes lose
/// nothing, whatever the other component does. few: heights of few values, which are taken whatever
/// their prefixes lose.
std::optional<Selection> losslessIfItFits(const EncodeInputs& inputs, const Candidates& lossy,
                                          const std::optional<HeightsCandidate>& few,
                                          const ByNeighbours& neighbours) {
  const auto& [heights, texture, errors] = lossy;
  if (!heights.coded && !hasLosslessWay(*texture.coded)) return {};
  Candidates exact = lossy;
  uint64_t room = inputs.options.bytes;
  if (texture.coded) {
    std::optional<TextureCandidate> whole =
        within(room, exactTexture(inputs, texture, room), texture);
    if (!whole) return {};
    exact.texture = *std::move(whole);
    room -= exact.texture.bytes();
  }
  if (heights.coded) {
    std::optional<HeightsCandidate> whole =
        within(room, few ? few : exactHeights(inputs, heights, neighbours, room), heights);
    if (!whole) return {};
    exact.heights = *std::move(whole);
    if (few) exact.errors = nullptr;
  }
  return selectIfLossless(inputs, std::move(exact));
}

/// The errors of the picture with rising parts of the budget, the last of which is all of it;
/// nothing if nobody can look at the terrain.
std::vector<double> errorsWithin(const EncodeInputs& inputs, const PrefixErrors& errors,
                                 Selection selection) {
  selection.packets = joinNeighbours(selection.packets);
  std::vector<uint64_t> lengths;
  for (const double part : kPictureParts)
    lengths.push_back(static_cast<uint64_t>(part * static_cast<double>(inputs.options.bytes)));
  return errors.of(selection, lengths);
}

/// Whether the tried pictures are as good with all bytes, and better by as many decibels as
/// prefixes lose in all. Errors that nobody can see do not count.
bool pays(const std::vector<double>& tried, const std::vector<double>& lossy) {
  double logarithms = 0;
  for (size_t i = 0; i < lossy.size(); ++i)
    logarithms += portable::log(std::max(tried[i], kUnseen) / std::max(lossy[i], kUnseen));
  return tried.back() <= lossy.back() && logarithms <= 0;
}

/// The packets in an order in which the heights end within the budget.
Selection endWithin(const EncodeInputs& inputs, Selection selection) {
  const uint64_t header = headerBytesOf(inputs, selection);
  const uint64_t room = inputs.options.bytes - std::min(inputs.options.bytes, header);
  selection.packets = endWithin(selection.packets, Component::kGeometry, kAllBytes, room);
  return selection;
}

/// The error of the picture at the end, and the bytes to there: the least is best.
using Ending = std::pair<double, uint64_t>;

Ending endingOf(const EncodeInputs& inputs, const Selection& selection,
                const std::vector<double>& errors) {
  return {errors.back(), std::min(inputs.options.bytes, bytesOfPackets(selection.packets))};
}

/// Exact heights beside as much of the texture as they leave room for, if the picture is better
/// than with lossy heights, or as good in fewer bytes: this is where everything has room, but the
/// hidden colours of a cut-out are not kept. few: heights of few values, of which only the end
/// counts. ways: to code heights of many values.
std::optional<Selection> exactHeightsIfTheyPay(const EncodeInputs& inputs, const Candidates& lossy,
                                               std::optional<HeightsCandidate> few,
                                               std::vector<HeightsCandidate> ways) {
  if (!few && ways.empty()) return {};
  const Selection inexact = orderPackets(lossy);
  const PrefixErrors errors_of(inputs, inexact);
  const std::vector<double> of_lossy = errorsWithin(inputs, errors_of, inexact);
  if (of_lossy.empty()) return {};
  Ending least = endingOf(inputs, inexact, of_lossy);
  std::optional<Selection> best;
  const auto consider = [&](const Candidates& exact, bool prefixes_count) {
    Selection selection = endWithin(inputs, orderPackets(exact));
    const std::vector<double> errors = errorsWithin(inputs, errors_of, selection);
    const Ending ending = endingOf(inputs, selection, errors);
    if (ending >= least || (prefixes_count && !pays(errors, of_lossy))) return;
    least = ending;
    best = std::move(selection);
  };
  for (HeightsCandidate& way : ways) consider({std::move(way), lossy.texture, lossy.errors}, true);
  // Pictures of a drawing are not those of coefficients: they have errors of their own.
  if (few) consider(withCurves(inputs, {*std::move(few), lossy.texture}), false);
  return best;
}

}  // namespace

std::optional<Selection> exactWithinBudget(const EncodeInputs& inputs, const Candidates& lossy,
                                           const Selection& selection) {
  assert(inputs.budgeted());
  HeightsOfFewValues of_few = fewValues(inputs, lossy.heights);
  std::optional<HeightsCandidate> few;
  if (of_few.fit) few = of_few.heights;
  const ByNeighbours neighbours(lossy.heights, inputs.options.bytes);
  const InReach in_reach = lastBitsInReach(inputs, selection, neighbours);
  if ((few || in_reach.heights) && in_reach.texture) {
    std::optional<Selection> exact = losslessIfItFits(inputs, lossy, few, neighbours);
    if (exact) return exact;
  }
  if (!lossy.texture.coded) {
    std::optional<Selection> exact = shortIfExact(inputs, lossy.heights, of_few.heights);
    return exact ? std::move(exact) : nearerPart(inputs, lossy, selection, of_few.heights);
  }
  if (!lossy.errors) return {};
  std::vector<HeightsCandidate> ways;
  if (in_reach.heights) ways = exactWays(inputs, lossy.heights, neighbours);
  return exactHeightsIfTheyPay(inputs, lossy, std::move(few), std::move(ways));
}

}  // namespace tetrakis::inline targets
