// SPDX-License-Identifier: Apache-2.0
// fewValues(), shortExactHeights(), exactHeights(), exactTexture() and exactWays() make the
// candidates of one component that end exact within a budget of bytes.
#include "encoder/targets/targets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/portable_math.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_encoder.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/heights/ways/ways.hpp"
#include "encoder/textures/coded_texture.hpp"

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

/// Whether there are exact heights, in at most `most` bytes. They are noted: exact heights that
/// have room may yet turn out worse than the lossy ones.
bool areWithin(const EncodeInputs& inputs, const HeightsCandidate& exact, uint64_t most) {
  if (!exact.coded) return false;
  const bool within = exact.bytes() <= most;
  note(inputs, *exact.coded, within ? Verdict::kWorseInBudget : Verdict::kNoRoom);
  return within;
}

}  // namespace

HeightsOfFewValues fewValues(const EncodeInputs& inputs, const HeightsCandidate& lossy) {
  constexpr double kAnyError = std::numeric_limits<double>::infinity();
  if (!lossy.coded) return {};
  const auto budget = static_cast<double>(inputs.options.bytes);
  const uint64_t room = std::min(inputs.options.bytes, lossy.bytes());
  const auto most = static_cast<uint64_t>(budget / kLargePart);
  const QuantisedHeights& quantised = *lossy.coded->quantised;
  const bool few = drawingMayFit(
      {quantised.steps.steps, extentOf(*quantised.samples), quantised.steps.valid}, most);
  if (!few && !isGenerous(inputs, *lossy.coded)) return {};
  HeightsOfFewValues exact{{exactHeightsFor(inputs, kAnyError, most)}};
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

namespace {

/// Longer parts of a lossless component than these look like the whole of it: photographs have 40
/// dB. Larger parts let late prefixes decide, which lossless components show as well.
constexpr double kMostOfHeights = 1. / 2, kMostOfTexels = 1. / 8;
/// The parts of these parts at which prefixes are compared. More of them take the time of decoding
/// two prefixes each.
constexpr std::array<double, 5> kComparedParts = {1. / 16, 1. / 8, 1. / 4, 1. / 2, 1.};
/// A prefix of a lossless component may take this many times the bytes of a lossy one. A larger
/// factor ends more streams exact, and their prefixes lose as many bytes.
constexpr double kPriceOfExact = 1.03;
/// The RMSE, in steps, from which on corrections follow. Finer cuts take as many bytes or more in
/// all, and behind coarser cuts prefixes lose quality.
constexpr double kExactCut = 0.3;
/// The same beside a texture that is not exact: the texture gains more from 3 % of the bytes than
/// prefixes lose.
constexpr double kSharedExactCut = 0.5;
/// Budgets above this many times the bytes of texels in tables end with the tables. A larger number
/// compares prefixes more often; a smaller one costs prefixes quality.
constexpr uint64_t kRoomOfTexelTable = 2;

/// Whether the candidate takes fewer bytes than the room. It is noted: what has room may yet turn
/// out worse than the lossy candidate.
template <class Coded>
bool hasRoom(const EncodeInputs& inputs, const Candidate<Coded>& candidate, uint64_t room) {
  const bool has_room = candidate.bytes() < room;
  note(inputs, *candidate.coded, has_room ? Verdict::kWorseInBudget : Verdict::kNoRoom);
  return has_room;
}

/// The lossy heights with corrections that restore their samples, made in each way that takes fewer
/// than `room` bytes.
std::vector<HeightsCandidate> restoredWithin(const EncodeInputs& inputs, const CodedHeights& lossy,
                                             const ByNeighbours& neighbours, uint64_t room) {
  const uint32_t threads = inputs.options.threads;
  std::vector<HeightsCandidate> ways;
  const auto add = [&](std::optional<CodedHeights> way) {
    if (!way) return;
    HeightsCandidate candidate = candidateOf(*std::move(way));
    if (hasRoom(inputs, candidate, room)) ways.push_back(std::move(candidate));
  };
  if (neighbours.relative_step > 0) add(codeRelative(lossy, neighbours.relative_step, threads));
  if (neighbours.facets) {
    std::optional<CodedHeights> way = codeFacets(lossy, *neighbours.facets, room, threads);
    add(way ? std::move(way) : codeFacets(inputs, *neighbours.facets));
  }
  if (canBeRestored(lossy)) add(codeRestored(inputs, lossy));
  return ways;
}

/// Whether prefixes of the first candidate, up to a part of it, are as good in the mean as prefixes
/// of the second that have a few percent fewer bytes; else the first is noted. Both have curves.
template <class Coded>
bool keepsPrefixes(const EncodeInputs& inputs, const Candidate<Coded>& tried,
                   const Candidate<Coded>& lossy, double most) {
  const auto squares_after = [&](const Candidate<Coded>& candidate, double bytes) {
    const Codewords prefix = prefixAfter(candidate.coded->accounted(), candidate.curve->packets,
                                         static_cast<uint64_t>(bytes));
    return squaresOf(*candidate.coded, prefix, inputs.options.threads);
  };
  double logarithms = 0;
  for (const double part : kComparedParts) {
    const double bytes = part * most * static_cast<double>(tried.bytes());
    logarithms +=
        portable::log(squares_after(tried, bytes) / squares_after(lossy, bytes / kPriceOfExact));
  }
  if (logarithms > 0) note(inputs, *tried.coded, Verdict::kWorsePrefixes);
  return logarithms <= 0;
}

bool canBeCorrected(const CodedHeights& heights) {
  return hasLosslessWay(heights) && heights.quantised->table.empty();
}

/// The heights with corrections in fewer than `room` bytes. The cut is fine, so that prefixes are
/// those of the lossy heights for long, unless this takes far more bytes than another cut.
std::optional<HeightsCandidate> correctedHeights(const EncodeInputs& inputs,
                                                 const CodedHeights& lossy, uint64_t room) {
  std::optional<CodedHeights> corrected = codeCorrected(inputs, lossy, kExactCut);
  const uint64_t bytes = corrected ? bytesOf(corrected->tracks) : room;
  if (const std::optional<double> rmse = farShorterCut(lossy, bytes)) {
    if (corrected) note(inputs, *corrected, Verdict::kLonger);
    corrected = codeCorrected(inputs, lossy, std::max(*rmse, kExactCut));
  }
  if (!corrected) return {};
  HeightsCandidate candidate = candidateOf(*std::move(corrected));
  if (!hasRoom(inputs, candidate, room)) return {};
  return candidate;
}

}  // namespace

ByNeighbours::ByNeighbours(const HeightsCandidate& lossy, uint64_t room) {
  if (!lossy.coded) return;
  relative_step = relativeStepOf(*lossy.coded);
  facets = facetsOf(*lossy.coded, room);
}

std::optional<HeightsCandidate> exactHeights(const EncodeInputs& inputs,
                                             const HeightsCandidate& lossy,
                                             const ByNeighbours& neighbours, uint64_t room) {
  std::vector<HeightsCandidate> ways = restoredWithin(inputs, *lossy.coded, neighbours, room);
  if (!ways.empty()) return fewestBytes(std::move(ways), notingLonger(inputs));
  if (!hasLosslessWay(*lossy.coded)) return {};
  if (canBeCorrected(*lossy.coded)) {
    if (auto corrected = correctedHeights(inputs, *lossy.coded, room)) return corrected;
  }
  HeightsCandidate whole = codeLossless(inputs, *lossy.coded);
  if (!hasRoom(inputs, whole, room)) return {};
  whole.curve = curveOfHeights(inputs, *whole.coded);
  if (!keepsPrefixes(inputs, whole, lossy, kMostOfHeights)) return {};
  return whole;
}

std::optional<TextureCandidate> exactTexture(const EncodeInputs& inputs,
                                             const TextureCandidate& lossy, uint64_t room) {
  if (!hasLosslessWay(*lossy.coded)) return lossy;
  const bool few = gapOfValues(*lossy.coded) > 1;
  TextureCandidate whole =
      few ? codeLossless(inputs, *lossy.coded) : candidateOf(codeReversibly(inputs, *lossy.coded));
  if (lossy.coded->header.direct() && lossy.bytes() <= whole.bytes()) {
    note(inputs, *whole.coded, Verdict::kLonger);
    return lossy;
  }
  if (!hasRoom(inputs, whole, room)) return {};
  whole.curve = curveOfTexture(inputs, *whole.coded);
  if (few && kRoomOfTexelTable * whole.bytes() <= inputs.options.bytes) return whole;
  if (!keepsPrefixes(inputs, whole, lossy, kMostOfTexels)) return {};
  return whole;
}

std::vector<HeightsCandidate> exactWays(const EncodeInputs& inputs, const HeightsCandidate& lossy,
                                        const ByNeighbours& neighbours) {
  std::vector<HeightsCandidate> ways;
  const auto add = [&](HeightsCandidate way) {
    if (!hasRoom(inputs, way, inputs.options.bytes)) return;
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

}  // namespace tetrakis::inline targets
