// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/bounded_heights.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "codec/geometry/bound_choice.hpp"
#include "codec/geometry/corrected_cut.hpp"
#include "codec/geometry/drawn_heights/drawing_estimate.hpp"
#include "codec/geometry/quantiser/step_choice.hpp"
#include "codec/geometry/quantiser/step_errors.hpp"
#include "codec/geometry/quantiser/voids.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "encoder/heights/height_errors.hpp"
#include "encoder/heights/restored_heights.hpp"
#include "ratecontrol/candidate.hpp"
#include "wavelet/priority_map_encoder.hpp"

namespace tetrakis::inline heights {

namespace {

using Quantised = std::shared_ptr<const QuantisedHeights>;

/// What all attempts have in common.
struct Bound {
  Quantised of;
  Purpose purpose;        ///< of coefficients that will be cut
  WaveletHeader wavelet;  ///< that suits them where nothing is flat
  CoefficientOptions options;
  double error;  ///< the largest one wanted, in sample units, less what floats lose by rounding
};

/// The distance from the largest sample to the next float; 0 for integers, which are exact.
double floatSpacing(const QuantisedHeights& heights) {
  if (heights.samples->sample != TKS_F32) return 0;
  const SampleRange range = rangeOf(*heights.samples, heights.steps.valid);
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  return std::ldexp(1.0, spacingExponent(static_cast<float>(largest)));
}

/// The same heights in other steps, coded to the last bit.
CodedHeights codeRounded(const Bound& bound, HeightSteps steps) {
  assert(!bound.of->restored());
  auto rounded = std::make_shared<QuantisedHeights>();
  rounded->samples = bound.of->samples;
  rounded->layers = bound.of->layers;
  rounded->shown_by = bound.of->shown_by;
  rounded->validity = bound.of->validity;
  rounded->steps = std::move(steps);
  if (!rounded->steps.exact) rounded->left = rounded->squaresOf(rounded->steps);
  HeightTarget target(Purpose::kLossless);
  target.tried = true;
  return codeHeights(std::move(rounded), target, bound.options);
}

/// Floats whose step is not given, rounded to the widest step that the bound allows; nothing if
/// there is none wider than the exact one, or multiples of that are clearly wider.
std::optional<CodedHeights> widen(const Bound& bound, int32_t largest) {
  constexpr double kClearly = 1.02;
  const tks_heights& samples = *bound.of->samples;
  const double widest = 2 * bound.error, exact = bound.of->steps.step;
  if (samples.sample != TKS_F32 || samples.step > 0 || widest <= exact) return {};
  if ((2.0 * largest + 1) * exact > kClearly * widest) return {};
  Result<HeightSteps> wide = toSteps(samples, {.given = widest});
  if (!wide.ok()) return {};
  return codeRounded(bound, std::move(*wide));
}

/// Rounds to multiples of the exact step.
CodedHeights round(const Bound& bound, int32_t largest) {
  HeightSteps steps = bound.of->steps;
  if (largest > 0) {
    for (int32_t& q : steps.steps) q = nearestMultiple(q, largest);
    steps.step *= 2 * largest + 1;
    steps.exact = false;
    steps.range_bits = std::max(steps.range_bits - std::ilogb(2 * largest + 1), 1);
  }
  return codeRounded(bound, std::move(steps));
}

/// The first bytes of a track of coefficients.
EncodedTrack cutAt(const EncodedTrack& whole, uint64_t bytes) {
  assert(bytes <= whole.codeword.size());
  EncodedTrack cut = whole;
  cut.codeword.resize(bytes);
  std::erase_if(cut.points, [&](const RatePoint& p) { return p.bytes > 0 && p.bytes >= bytes; });
  cut.complete = false;
  if (bytes > 0) cut.points.push_back({bytes, distortionAt(whole.points, bytes)});
  return cut;
}

/// What a cut that corrections follow usually leaves.
HeightPurpose cutPurpose(const Bound& bound, int32_t largest) {
  return {bound.of->steps.range_bits, bound.purpose, UINT64_MAX, usualCut(largest),
          bound.options.threads};
}

FlatChoice flatAreasOf(const Bound& bound, int32_t largest) {
  const HeightSteps& steps = bound.of->steps;
  return chooseFlatAreas({steps.steps, extentOf(*bound.of->samples), steps.valid},
                         cutPurpose(bound, largest));
}

/// One track of coefficients as a whole, and what lies around it.
struct UncutHeights {
  HeightLayers layers;
  EncodedTrack track;
};

/// enough: the mean squared error, in steps, at which coding ends; 0: it does not.
UncutHeights codeUncut(const Bound& bound, FlatChoice choice, double enough) {
  const QuantisedHeights& heights = *bound.of;
  HeightLayers layers = layersAround(heights, std::move(choice), bound.options.priorities);
  CoefficientOptions options = layers.flat.beside(bound.options);
  if (enough > 0) options.enough = enough * heights.counted();
  EncodedTrack track = std::move(codeCoefficients(heights, layers.wavelet, options).front());
  layers.wavelet.rounded_bytes = exactBytes(std::span(&track, 1));
  return {std::move(layers), std::move(track)};
}

/// The layers with corrections to a largest error. distortion: of the cut before them, in the
/// account's own measure, which the audit corrects later.
HeightLayers withCorrections(HeightLayers layers, const Corrected& corrected, int32_t largest,
                             double distortion) {
  if (corrected.codeword.empty()) return layers;
  layers.corrections = corrected.codeword;
  layers.corrected_to = distortion * corrected.after / corrected.before;
  layers.layers.corrections = CorrectionKind::kSteps;
  layers.layers.correction_step = static_cast<uint32_t>(2 * largest + 1);
  return layers;
}

/// What a cut is to be.
struct CutTarget {
  std::optional<double> mean_square = {};  ///< that it leaves, in steps; nothing: fewest bytes
  uint64_t rival = UINT64_MAX;             ///< heights that clearly take more bytes are of no use
};

/// Coding ends at a small part of the error that cuts usually leave, unless the best one comes near
/// that.
CodedHeights correct(const Bound& bound, int32_t largest, const FlatChoice& choice,
                     const CutTarget& target, bool to_the_end = false) {
  constexpr double kPart = 1. / 32, kNear = 1.5;
  const QuantisedHeights& heights = *bound.of;
  assert(heights.corrections.empty());
  const double left = target.mean_square.value_or(usualCut(largest));
  const auto [layers, track] = codeUncut(bound, choice, to_the_end ? 0 : left * kPart);
  const GeometryHeader header = headerOf(heights, layers, track.planes);
  CorrectedCut cut(heights.steps, layers.flat.areas, header, track, largest);
  const uint64_t bytes =
      target.mean_square ? cut.bytesFor(*target.mean_square) : cut.best(target.rival);
  const bool near = kNear * static_cast<double>(bytes) > static_cast<double>(track.codeword.size());
  if (near && !to_the_end && !track.complete) return correct(bound, largest, choice, target, true);
  const Corrected corrected = cut.correct(bytes);
  const double distortion = distortionAt(track.points, bytes);
  return joinLayers(bound.of, withCorrections(layers, corrected, largest, distortion),
                    {cutAt(track, bytes)}, bound.options.region_log2);
}

uint64_t fewestOf(const std::vector<Candidate<CodedHeights>>& made) {
  uint64_t fewest = UINT64_MAX;
  for (const auto& one : made) fewest = std::min(fewest, one.bytes());
  return fewest;
}

/// All attempts at a largest error in steps, whether they keep it or not.
std::vector<Candidate<CodedHeights>> attempts(const Bound& bound, int32_t largest) {
  const tks_heights& samples = *bound.of->samples;
  const BoundWays ways = boundWays(bound.of->steps, extentOf(samples), bound.wavelet, largest);
  std::vector<Candidate<CodedHeights>> made;
  if (ways.round) {
    if (std::optional<CodedHeights> wide = widen(bound, largest))
      made.push_back(candidateOf(*std::move(wide)));
    made.push_back(candidateOf(round(bound, largest)));
  }
  const bool one_track = bound.options.region_log2 == 0;  // is cut, not many
  if (ways.correct && one_track)
    made.push_back(candidateOf(
        correct(bound, largest, flatAreasOf(bound, largest), {ways.mean_square, fewestOf(made)})));
  return made;
}

/// The samples that coefficients show: valid ones outside flat areas; empty: all.
std::vector<uint8_t> freeSamples(const CodedHeights& heights) {
  std::vector<uint8_t> free = heights.of->steps.valid;
  const std::vector<uint16_t>& areas = heights.flat.areas.numbers;
  if (free.empty()) free.assign(areas.size(), 1);
  for (size_t i = 0; i < areas.size(); ++i) free[i] = free[i] != 0 && areas[i] == 0;
  return free;
}

bool keepsBound(const EncodeInputs& inputs, const CodedHeights& coded) {
  const SampleErrors errors =
      sampleErrorsOf(coded, codewordsOf(coded.tracks), inputs.options.threads);
  return errors.largest * std::abs(inputs.heights->scale) <= inputs.options.max_error;
}

}  // namespace

/// Exact steps leave an error of their own; what is left of the bound, in whole steps, the coding
/// may use. Where floats are then rounded beyond the bound one step less will do; none, the exact
/// steps, is always within.
std::shared_ptr<const CodedHeights> codeBoundedHeights(const EncodeInputs& inputs, Quantised of) {
  const double wanted = inputs.options.max_error / std::abs(inputs.heights->scale);
  assert(wanted > 0);
  const CoefficientOptions options = heightOptions(inputs);
  const auto exactly = [&] {
    return candidateOf(codeHeights(of, Purpose::kLossless, options)).coded;
  };
  if (of->restored()) return exactly();
  const double finest = of->steps.step * std::abs(inputs.heights->scale);
  const bool fine = inputs.options.max_error < 2 * finest;
  const Purpose purpose = fine ? Purpose::kLossless : Purpose::kLossy;
  const Bound bound{of, purpose, chooseHeightFilters(*of, purpose), options,
                    wanted - floatSpacing(*of) / 2};
  const double room = (wanted - errorsOf(*inputs.heights, of->steps).largest) / of->steps.step;
  constexpr double kMost = 1 << 24;
  const auto largest = static_cast<int32_t>(std::clamp(room + 1e-9, 0.0, kMost));
  std::vector<Candidate<CodedHeights>> kept;
  for (const int32_t tried : {largest, std::max(largest - 1, 0), 0}) {
    if (tried == 0 && !kept.empty()) break;
    std::vector<Candidate<CodedHeights>> made = attempts(bound, tried);
    std::stable_sort(made.begin(), made.end(),
                     [](const auto& a, const auto& b) { return a.bytes() < b.bytes(); });
    const auto keeps = [&](const auto& one) { return keepsBound(inputs, *one.coded); };
    const auto shortest = std::find_if(made.begin(), made.end(), keeps);
    if (shortest != made.end()) kept.push_back(*shortest);
    if (shortest == made.begin()) break;  // longer ones need not be looked at
  }
  if (kept.empty()) return exactly();
  const std::shared_ptr<const CodedHeights> best = fewestBytes(std::move(kept)).coded;
  return std::make_shared<const CodedHeights>(withRounding(*best));
}

namespace {

/// Whether corrections behind a cut may take fewer bytes than the whole coefficients. In the mean
/// of all samples flat areas hide what the free ones would gain; where the areas are holes in
/// noise, free samples alone lack the surface that the transform would have without areas. Either
/// hint is worth a trial.
bool correctionsMayPay(const CodedHeights& whole) {
  const HeightSteps& steps = whole.of->steps;
  const uint64_t bytes = bytesOf(whole.tracks);
  const auto may_pay = [&](const std::vector<uint8_t>& mask) {
    const PlaneView<const int32_t> plane(steps.steps, extentOf(*whole.of->samples), mask);
    return correctionsMayPay(plane, steps.range_bits, bytes);
  };
  const bool some_flat = !whole.flat.areas.heights.empty();
  return may_pay(freeSamples(whole)) || (some_flat && may_pay(steps.valid));
}

/// Codes heights to the last bit by wavelet: all of their coefficients, or a cut of lossy ones with
/// corrections behind it.
std::shared_ptr<const CodedHeights> codeToTheLastBit(const EncodeInputs& inputs,
                                                     const Quantised& of) {
  CoefficientOptions options = heightOptions(inputs);
  auto whole = candidateOf(codeHeights(of, Purpose::kLossless, options));
  const HeightSteps& steps = of->steps;
  if (whole.coded->tracks.size() > 1 || !steps.exact || !steps.table.empty()) return whole.coded;
  if (!correctionsMayPay(*whole.coded)) return whole.coded;
  options.limit = whole.bytes();
  const Bound bound{of, Purpose::kLossy, chooseHeightFilters(*of, Purpose::kLossy), options, 0};
  auto corrected = candidateOf(correct(bound, 0, flatAreasOf(bound, 0), {{}, whole.bytes()}));
  // Without corrections its account would not end at exact.
  if (corrected.coded->layers.corrections == CorrectionKind::kNone) return whole.coded;
  return fewestBytes<CodedHeights>({std::move(whole), std::move(corrected)}).coded;
}

/// Samples with a relative step take far fewer bytes from it, but for those that a table holds.
std::shared_ptr<const CodedHeights> codeFromRelative(const EncodeInputs& inputs,
                                                     const QuantisedHeights& of) {
  const double relative_step = relativeStepOf(of);
  const Quantised fine = relative_step > 0 ? quantiseForRelative(inputs, relative_step) : nullptr;
  return fine ? candidateOf(codeRelative(inputs, fine, relative_step)).coded : nullptr;
}

}  // namespace

/// A drawing shows shapes and slopes between them, and no roughness: its prefixes suit only heights
/// of few values, of which it takes clearly fewer bytes than the wavelet. So it has to save a
/// sixteenth. It is tried where the estimate, which is often off by a twentieth, says that it is
/// the shorter one.
std::shared_ptr<const CodedHeights> codeLosslessHeights(const EncodeInputs& inputs,
                                                        const Quantised& of) {
  constexpr double kEstimateOff = 1.05, kMostOfWavelet = 15. / 16;
  const std::shared_ptr<const CodedHeights> relative = codeFromRelative(inputs, *of);
  if (relative && of->table.empty()) return relative;
  std::shared_ptr<const CodedHeights> whole = codeToTheLastBit(inputs, of);
  if (relative) whole = fewestBytes<CodedHeights>({{std::move(whole)}, {relative}}).coded;
  if (whole->tracks.size() > 1) return whole;
  const HeightSteps& steps = of->steps;
  const auto bytes = static_cast<double>(bytesOf(whole->tracks));
  if (estimateDrawing({steps.steps, extentOf(*of->samples), steps.valid}) > kEstimateOff * bytes)
    return whole;
  std::optional<CodedHeights> drawn = drawHeights(of);
  if (!drawn || static_cast<double>(bytesOf(drawn->tracks)) > kMostOfWavelet * bytes) return whole;
  return std::make_shared<const CodedHeights>(*std::move(drawn));
}

CodedHeights codeCorrected(const EncodeInputs& inputs, const CodedHeights& lossy, double cut) {
  assert(lossy.tracks.size() == 1 && lossy.of->steps.exact && lossy.of->table.empty());
  const WaveletHeader& wavelet = lossy.header.wavelet;
  const Bound bound{lossy.of, Purpose::kLossy, wavelet, heightOptions(inputs), 0};
  return correct(bound, 0, {lossy.flat, wavelet}, {cut * cut});
}

}  // namespace tetrakis::inline heights
