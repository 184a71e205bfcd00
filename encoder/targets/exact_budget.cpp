// SPDX-License-Identifier: Apache-2.0
#include "encoder/targets/exact_budget.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "encoder/heights/height_errors.hpp"
#include "encoder/heights/ways/corrected_heights.hpp"
#include "encoder/heights/ways/facet_heights.hpp"
#include "encoder/heights/ways/relative_heights.hpp"
#include "encoder/heights/ways/restored_heights.hpp"
#include "encoder/selection/write_stream.hpp"
#include "encoder/targets/component_curves.hpp"
#include "encoder/targets/other_exact_heights.hpp"
#include "encoder/views/errors_of_prefixes.hpp"
#include "ratecontrol/allocation/allocation.hpp"
#include "ratecontrol/needs/target.hpp"

namespace tetrakis::inline targets {

namespace {

/// How neighbours restore samples that are on no grid of steps.
struct ByNeighbours {
  double relative_step = 0;  ///< in sample units; 0: none
  std::optional<FacetShare> facets = {};

  /// lossy: the heights, if there are any. room: bytes that there are for them.
  ByNeighbours(const HeightsCandidate& lossy, uint64_t room) {
    if (!lossy.coded) return;
    relative_step = relativeStepOf(*lossy.coded);
    facets = facetsOf(*lossy.coded, room);
  }
};

/// The lossy heights with what restores them, each way in less than so many bytes.
std::vector<HeightsCandidate> restoredWithin(const EncodeInputs& inputs, const CodedHeights& lossy,
                                             const ByNeighbours& neighbours, uint64_t room) {
  const uint32_t threads = inputs.options.threads;
  std::vector<HeightsCandidate> ways;
  const auto add = [&](std::optional<CodedHeights> way) {
    if (way && bytesOf(way->tracks) < room) ways.push_back(candidateOf(*std::move(way)));
  };
  if (neighbours.relative_step > 0) add(codeRelative(lossy, neighbours.relative_step, threads));
  if (neighbours.facets) {
    std::optional<CodedHeights> way = codeFacets(lossy, *neighbours.facets, room, threads);
    add(way ? std::move(way) : codeFacets(inputs, *neighbours.facets));
  }
  if (canBeRestored(lossy)) add(codeRestored(inputs, lossy));
  return ways;
}

/// The budget buys so much of a component, if there is one, that losslessness is in reach: all that
/// there is of it, or nearly all that it shows.
struct Nearly {
  bool heights, texture;
};

Nearly nearlyExact(const EncodeInputs& inputs, const Selection& selection,
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

/// Parts of a lossless component that are longer look like the whole of it: photographs have 40 dB.
constexpr double kMostOfHeights = 1. / 2, kMostOfTexels = 1. / 8;

/// Whether prefixes of the first candidate are as good, in the mean, as prefixes of the second that
/// have 3 % fewer bytes: those up to a part of it. Both have curves.
template <class Coded>
bool keepsPrefixes(const EncodeInputs& inputs, const Candidate<Coded>& tried,
                   const Candidate<Coded>& lossy, double most) {
  const auto squares_after = [&](const Candidate<Coded>& candidate, double bytes) {
    const Codewords prefix = prefixAfter(candidate.coded->accounted(), candidate.curve->packets,
                                         static_cast<uint64_t>(bytes));
    return squaresOf(*candidate.coded, prefix, inputs.options.threads);
  };
  double logarithms = 0;
  for (const double part : {1. / 16, 1. / 8, 1. / 4, 1. / 2, 1.}) {
    const double bytes = part * most * static_cast<double>(tried.bytes());
    logarithms += std::log(squares_after(tried, bytes) / squares_after(lossy, bytes / 1.03));
  }
  return logarithms <= 0;
}

bool canBeCorrected(const CodedHeights& heights) {
  return hasLosslessWay(heights) && heights.quantised->table.empty();
}

/// The RMSE, in steps, from which on corrections follow. Finer cuts take as many bytes or more in
/// all, and behind coarser ones prefixes lose quality.
constexpr double kExactCut = 0.3;
/// Beside a texture that is not exact: it makes more of the 3 % of bytes than prefixes lose.
constexpr double kSharedExactCut = 0.5;

/// The heights with corrections in less than so many bytes: behind a fine cut, so that prefixes are
/// those of the lossy heights for long, unless that takes far more bytes than another.
std::optional<HeightsCandidate> correctedHeights(const EncodeInputs& inputs,
                                                 const CodedHeights& lossy, uint64_t room) {
  std::optional<CodedHeights> corrected = codeCorrected(inputs, lossy, kExactCut);
  const uint64_t bytes = corrected ? bytesOf(corrected->tracks) : room;
  if (const std::optional<double> rmse = farShorterCut(lossy, bytes))
    corrected = codeCorrected(inputs, lossy, std::max(*rmse, kExactCut));
  if (!corrected || bytesOf(corrected->tracks) >= room) return {};
  return candidateOf(*std::move(corrected));
}

/// The heights to the last bit in less than so many bytes, if their prefixes are as good as those
/// of the lossy heights. Where samples are on no grid the way of fewer bytes is taken.
std::optional<HeightsCandidate> exactHeights(const EncodeInputs& inputs,
                                             const HeightsCandidate& lossy,
                                             const ByNeighbours& neighbours, uint64_t room) {
  std::vector<HeightsCandidate> ways = restoredWithin(inputs, *lossy.coded, neighbours, room);
  if (!ways.empty()) return fewestBytes(std::move(ways));
  if (!hasLosslessWay(*lossy.coded)) return {};
  if (canBeCorrected(*lossy.coded)) {
    if (auto corrected = correctedHeights(inputs, *lossy.coded, room)) return corrected;
  }
  HeightsCandidate whole = codeLossless(inputs, *lossy.coded);
  if (whole.bytes() >= room) return {};
  whole.curve = curveOfHeights(inputs, *whole.coded);
  if (!keepsPrefixes(inputs, whole, lossy, kMostOfHeights)) return {};
  return whole;
}

/// The texture likewise. Drawn and stored ones are lossless as they stand, but tables of values may
/// take fewer bytes; where these leave half of the budget, prefixes do not matter.
std::optional<TextureCandidate> exactTexture(const EncodeInputs& inputs,
                                             const TextureCandidate& lossy, uint64_t room) {
  if (!hasLosslessWay(*lossy.coded)) return lossy;
  const bool few = gapOfValues(*lossy.coded) > 1;
  TextureCandidate whole =
      few ? codeLossless(inputs, *lossy.coded) : candidateOf(codeReversibly(inputs, *lossy.coded));
  if (lossy.coded->header.direct() && lossy.bytes() <= whole.bytes()) return lossy;
  if (whole.bytes() >= room) return {};
  whole.curve = curveOfTexture(inputs, *whole.coded);
  if (few && 2 * whole.bytes() <= inputs.options.bytes) return whole;
  if (!keepsPrefixes(inputs, whole, lossy, kMostOfTexels)) return {};
  return whole;
}

/// All packets of the candidates, if they restore everything.
std::optional<Selection> selectIfLossless(const EncodeInputs& inputs, Candidates exact) {
  Selection selection = orderPackets(withCurves(inputs, std::move(exact)));
  Selection joined = selection;
  joined.packets = joinNeighbours(selection.packets);
  if (!isLossless(inputs, joined)) return {};
  return selection;
}

/// Heights whose shortest stream takes clearly less than the budget.
std::optional<Selection> shortIfExact(const EncodeInputs& inputs, const HeightsCandidate& lossy,
                                      const HeightsCandidate& few) {
  HeightsCandidate heights = shortExactHeights(inputs, lossy, few);
  if (!heights.coded) return {};
  return selectIfLossless(inputs, {std::move(heights), {}});
}

/// A part of exact heights of few values, if that is nearer than as much of the lossy ones.
std::optional<Selection> nearerPart(const EncodeInputs& inputs, const Candidates& lossy,
                                    const Selection& selection, const HeightsCandidate& few) {
  const uint64_t header = headerBytesOf(inputs, selection);
  if (!few.coded || header >= inputs.options.bytes) return {};
  if (!isNearer(inputs, few, lossy.heights, inputs.options.bytes - header)) return {};
  return orderPackets({few, {}});
}

/// The way to the last bit, if there is one that takes less than the room; else the lossy component
/// as it stands, if all of it does: it may be exact as well, in more bytes.
template <class Coded>
std::optional<Candidate<Coded>> within(uint64_t room, std::optional<Candidate<Coded>> exact,
                                       const Candidate<Coded>& lossy) {
  if (exact && exact->bytes() < room) return exact;
  const bool whole = std::all_of(lossy.coded->tracks.begin(), lossy.coded->tracks.end(),
                                 [](const EncodedTrack& track) { return track.complete; });
  if (!whole || lossy.bytes() >= room) return {};
  return lossy;
}

/// Everything to the last bit, if that fits the budget and takes nothing from prefixes: of each
/// component, whatever the other one does. few: heights of few values, which are taken as they are.
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

/// Ways of heights to the last bit in less than the budget whose prefixes are as good as those of
/// the lossy heights, which have a curve. Coefficients of a cut are those of the
/// lossy heights, unless only the lossless way fits.
std::vector<HeightsCandidate> exactWays(const EncodeInputs& inputs, const HeightsCandidate& lossy,
                                        const ByNeighbours& neighbours) {
  std::vector<HeightsCandidate> ways;
  const auto add = [&](HeightsCandidate way) {
    if (way.bytes() >= inputs.options.bytes) return;
    way.curve = curveOfHeights(inputs, *way.coded);
    if (!way.coded->hasCorrections() && !keepsPrefixes(inputs, way, lossy, kMostOfHeights)) return;
    ways.push_back(std::move(way));
  };
  for (HeightsCandidate& way :
       restoredWithin(inputs, *lossy.coded, neighbours, inputs.options.bytes))
    add(std::move(way));
  if (canBeCorrected(*lossy.coded)) {
    if (auto corrected = codeCorrected(inputs, *lossy.coded, kSharedExactCut))
      add(candidateOf(*std::move(corrected)));
  }
  if (hasLosslessWay(*lossy.coded)) add(codeLossless(inputs, *lossy.coded));
  return ways;
}

/// What the picture lacks with rising parts of the budget, the last of which is all of it; nothing
/// if nobody can look at the terrain.
std::vector<double> errorsWithin(const EncodeInputs& inputs, Selection selection) {
  selection.packets = joinNeighbours(selection.packets);
  std::vector<uint64_t> lengths;
  for (const double part : {1. / 16, 1. / 8, 1. / 4, 1. / 2, 3. / 4, 1.})
    lengths.push_back(static_cast<uint64_t>(part * static_cast<double>(inputs.options.bytes)));
  return errorsOfPrefixes(inputs, selection, lengths);
}

/// As good with all bytes, and better by as many decibels as prefixes lose in all, up to what can
/// be seen.
bool pays(const std::vector<double>& tried, const std::vector<double>& lossy) {
  constexpr double kUnseen = 65025e-6;  // 60 dB
  double logarithms = 0;
  for (size_t i = 0; i < lossy.size(); ++i)
    logarithms += std::log(std::max(tried[i], kUnseen) / std::max(lossy[i], kUnseen));
  return tried.back() <= lossy.back() && logarithms <= 0;
}

/// The packets in an order in which the heights end within the budget.
Selection endWithin(const EncodeInputs& inputs, Selection selection) {
  const uint64_t header = headerBytesOf(inputs, selection);
  const uint64_t room = inputs.options.bytes - std::min(inputs.options.bytes, header);
  selection.packets = endWithin(selection.packets, Component::kGeometry, kAllBytes, room);
  return selection;
}

/// What the picture lacks at the end, and the bytes that come so far: the least is best.
using Ending = std::pair<double, uint64_t>;

Ending endingOf(const EncodeInputs& inputs, const Selection& selection,
                const std::vector<double>& errors) {
  return {errors.back(), std::min(inputs.options.bytes, bytesOfPackets(selection.packets))};
}

/// Exact heights beside as much of the texture as they leave, if that looks better than lossy ones,
/// or as good in fewer bytes: where all has room, but the hidden colours of a cut-out are not kept.
/// few: heights of few values, of which only the end counts. ways: of many values.
std::optional<Selection> exactHeightsIfTheyPay(const EncodeInputs& inputs, const Candidates& lossy,
                                               std::optional<HeightsCandidate> few,
                                               std::vector<HeightsCandidate> ways) {
  const size_t of_many = ways.size();
  if (few) ways.push_back(*std::move(few));
  if (ways.empty()) return {};
  const Selection inexact = orderPackets(lossy);
  const std::vector<double> of_lossy = errorsWithin(inputs, inexact);
  if (of_lossy.empty()) return {};
  Ending least = endingOf(inputs, inexact, of_lossy);
  std::optional<Selection> best;
  for (size_t i = 0; i < ways.size(); ++i) {
    Candidates exact = lossy;
    exact.heights = std::move(ways[i]);
    if (i >= of_many) {
      exact.errors = nullptr;  // pictures of a drawing are not those of coefficients
      exact = withCurves(inputs, std::move(exact));
    }
    Selection selection = endWithin(inputs, orderPackets(exact));
    const std::vector<double> errors = errorsWithin(inputs, selection);
    const Ending ending = endingOf(inputs, selection, errors);
    if (ending >= least || (i < of_many && !pays(errors, of_lossy))) continue;
    least = ending;
    best = std::move(selection);
  }
  return best;
}

}  // namespace

std::optional<Selection> exactWithinBudget(const EncodeInputs& inputs, const Candidates& lossy,
                                           const Selection& selection) {
  assert(inputs.budgeted());
  FewValues of_few = fewValues(inputs, lossy.heights);
  std::optional<HeightsCandidate> few;
  if (of_few.fit) few = of_few.heights;
  const ByNeighbours neighbours(lossy.heights, inputs.options.bytes);
  const Nearly nearly = nearlyExact(inputs, selection, neighbours);
  if ((few || nearly.heights) && nearly.texture) {
    std::optional<Selection> exact = losslessIfItFits(inputs, lossy, few, neighbours);
    if (exact) return exact;
  }
  if (!lossy.texture.coded) {
    std::optional<Selection> exact = shortIfExact(inputs, lossy.heights, of_few.heights);
    return exact ? std::move(exact) : nearerPart(inputs, lossy, selection, of_few.heights);
  }
  if (!lossy.errors) return {};
  std::vector<HeightsCandidate> ways;
  if (nearly.heights) ways = exactWays(inputs, lossy.heights, neighbours);
  return exactHeightsIfTheyPay(inputs, lossy, std::move(few), std::move(ways));
}

}  // namespace tetrakis::inline targets
