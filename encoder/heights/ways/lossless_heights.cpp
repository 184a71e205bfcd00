// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/ways/ways.hpp"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "codec/geometry/coding_choice/cuts.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_encoder.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/heights/quantised_heights.hpp"
#include "ratecontrol/needs/needs.hpp"

namespace tetrakis::inline ways {

namespace {

/// Multiples of a step are not tried beside a table if they are estimated at this many times its
/// bytes: estimates of few bits a sample are often a fifth too high. A larger factor takes time.
constexpr double kClearlyLonger = 1.25;
/// A drawing is tried if it is estimated at this many times the bytes of the wavelet: the estimate
/// is often off by a twentieth. A larger factor takes time, and a smaller one misses drawings.
constexpr double kEstimateOff = 1.05;
/// The share of the wavelet's bytes that a drawing may take. A larger share saves bytes, and gives
/// prefixes of more terrain shapes without roughness.
constexpr double kMostOfWavelet = 15. / 16;

using Quantised = std::shared_ptr<const QuantisedHeights>;

/// The samples that coefficients show: lifted ones outside flat areas; empty: all.
std::vector<uint8_t> freeSamples(const CodedHeights& heights) {
  const HeightSteps& steps = heights.quantised->steps;
  std::vector<uint8_t> free = steps.bridge > 0 ? steps.lifted : steps.valid;
  const std::vector<uint16_t>& areas = heights.flat.areas.numbers;
  if (free.empty()) free.assign(areas.size(), 1);
  for (size_t i = 0; i < areas.size(); ++i) free[i] = free[i] != 0 && areas[i] == 0;
  return free;
}

/// The best cut before corrections, which pays if it is as good as the whole coefficients. In the
/// mean of all samples flat areas hide the gain of the free ones; where the areas are holes in
/// noise, free samples alone lack the surface that the transform would have without areas. So a cut
/// is tried if either estimate suggests it. Cuts of smooth ground take down to half of the
/// estimate.
std::optional<ExactCut> exactCutFor(const CodedHeights& whole) {
  const HeightSteps& steps = whole.quantised->steps;
  const uint64_t bytes = bytesOf(whole.tracks) * (suitsSmoothGround(whole.header.wavelet) ? 2 : 1);
  const auto choose = [&](const std::vector<uint8_t>& mask) {
    const PlaneView<const int32_t> plane(steps.steps, extentOf(*whole.quantised->samples), mask);
    return estimateExactCut(plane, steps.range_bits, bytes);
  };
  const std::optional<ExactCut> of_free = choose(freeSamples(whole));
  if ((of_free && of_free->pays) || whole.flat.areas.heights.empty()) return of_free;
  return choose(steps.bridge > 0 ? steps.lifted : steps.valid);
}

/// The plan of a cut with exact corrections, before it is coded.
Plan planOf(const QuantisedHeights& quantised, const ExactCut& cut) {
  Plan plan = heights::planOf(quantised, Coding::kWavelet);
  plan.cut = std::sqrt(cut.mean_square);
  plan.residual = {Residual::Kind::kExact, 0, Predictor::kNeighbours};
  return plan;
}

/// The reason why an exact way loses to another one, of `bytes` bytes.
Verdict lostTo(uint64_t bytes, const CodedHeights& lost) {
  return bytesOf(lost.tracks) < bytes ? Verdict::kWorsePrefixes : Verdict::kLonger;
}

/// exactWorth() of heights behind a cut.
double worthOf(const CodedHeights& corrected) {
  uint64_t cut = 0;
  const size_t coefficients = corrected.tracks.size() - static_cast<size_t>(correctionTracks(
                                                            corrected.header, corrected.layers));
  for (size_t i = 0; i < coefficients; ++i) cut += corrected.tracks[i].codeword.size();
  return exactWorth(static_cast<double>(bytesOf(corrected.tracks)),
                    static_cast<double>(cut - corrected.correction_bytes));
}

/// Codes steps to the last bit by wavelet: all of their coefficients, or a cut of lossy ones with
/// corrections behind it.
std::shared_ptr<const CodedHeights> codeToTheLastBit(const EncodeInputs& inputs,
                                                     const Quantised& quantised) {
  CoefficientOptions options = heightOptions(inputs);
  auto whole = candidateOf(codeHeights(quantised, Purpose::kLossless, options));
  const HeightSteps& steps = quantised->steps;
  if (quantised->restored() || !steps.table.empty()) return whole.coded;
  const std::optional<ExactCut> cut = exactCutFor(*whole.coded);
  if (cut && !cut->pays) noteExpected(inputs, planOf(*quantised, *cut), cut->bytes);
  if (!cut || !cut->pays) return whole.coded;
  options.limit = whole.bytes();
  CodedHeights coded = codeCorrected({quantised, Purpose::kLossy, options}, {cut->mean_square});
  coded.expected = cut->bytes;
  auto corrected = candidateOf(std::move(coded));
  // Without corrections its account would not end at exact.
  const bool is_exact = corrected.coded->layers.corrections != CorrectionKind::kNone;
  if (!is_exact || !isWorth(worthOf(*corrected.coded), static_cast<double>(whole.bytes()))) {
    note(inputs, *corrected.coded, lostTo(whole.bytes(), *corrected.coded));
    return whole.coded;
  }
  return fewestBytes<CodedHeights>({std::move(whole), std::move(corrected)}, notingLonger(inputs))
      .coded;
}

/// Whether the steps need not be tried: by the estimate, their coefficients alone clearly take more
/// bytes, which is then noted. With few bits a sample the estimate is often too high by a fifth,
/// with few samples by more.
bool takesMore(const EncodeInputs& inputs, const QuantisedHeights& quantised, uint64_t bytes) {
  const HeightSteps& steps = quantised.steps;
  if (!steps.table.empty() || quantised.isSmall()) return false;
  const PlaneView<const int32_t> plane = steps.lifting(extentOf(*quantised.samples));
  const double estimated = typicalCost(plane, steps.range_bits, 0).bits / 8;
  const bool more = estimated > kClearlyLonger * static_cast<double>(bytes);
  if (more) noteExpected(inputs, heights::planOf(quantised, Coding::kWavelet), estimated);
  return more;
}

/// Codes samples that neighbours predict better than steps do: with a relative step, or on facets.
/// They mostly take far fewer bytes in this way.
std::shared_ptr<const CodedHeights> codeFromNeighbours(const EncodeInputs& inputs,
                                                       const QuantisedHeights& quantised) {
  std::vector<Candidate<CodedHeights>> ways;
  const double relative_step = relativeStepOf(quantised);
  if (const Quantised fine =
          relative_step > 0 ? quantiseForRelative(inputs, relative_step) : nullptr)
    ways.push_back(candidateOf(codeRelative(inputs, fine, relative_step)));
  if (const std::optional<FacetShare> facets = facetsOf(quantised)) {
    if (std::optional<CodedHeights> coded = codeFacets(inputs, *facets))
      ways.push_back(candidateOf(*std::move(coded)));
  }
  if (ways.empty()) return nullptr;
  return fewestBytes<CodedHeights>(std::move(ways), notingLonger(inputs)).coded;
}

/// Draws the steps, or keeps the heights coded by wavelet, `whole`. A drawing shows shapes and
/// slopes between them, and no roughness: its prefixes suit only heights of few values, which it
/// codes in clearly fewer bytes than the wavelet. So it has to save a part of the bytes. It is
/// tried where the estimate, which is often too high, says that it may be shorter.
std::shared_ptr<const CodedHeights> drawnIfShorter(const EncodeInputs& inputs,
                                                   const Quantised& quantised,
                                                   std::shared_ptr<const CodedHeights> whole) {
  if (whole->tracks.size() > 1) return whole;
  const HeightSteps& steps = quantised->steps;
  const uint64_t whole_bytes = bytesOf(whole->tracks);
  const auto bytes = static_cast<double>(whole_bytes);
  const double expected =
      estimateDrawing({steps.steps, extentOf(*quantised->samples), steps.valid});
  if (expected > kEstimateOff * bytes) {
    noteExpected(inputs, heights::planOf(*quantised, Coding::kDrawn), expected);
    return whole;
  }
  std::optional<CodedHeights> drawn = drawHeights(quantised);
  if (!drawn) return whole;
  drawn->expected = expected;
  if (static_cast<double>(bytesOf(drawn->tracks)) > kMostOfWavelet * bytes) {
    note(inputs, *drawn, lostTo(whole_bytes, *drawn));
    return whole;
  }
  note(inputs, *whole, Verdict::kLonger);
  return std::make_shared<const CodedHeights>(*std::move(drawn));
}

std::shared_ptr<const CodedHeights> codeInItsSteps(const EncodeInputs& inputs,
                                                   const Quantised& quantised) {
  const std::shared_ptr<const CodedHeights> near = codeFromNeighbours(inputs, *quantised);
  if (near && takesMore(inputs, *quantised, bytesOf(near->tracks))) return near;
  std::shared_ptr<const CodedHeights> whole = codeToTheLastBit(inputs, quantised);
  if (near)
    whole = fewestBytes<CodedHeights>({{std::move(whole)}, {near}}, notingLonger(inputs)).coded;
  return drawnIfShorter(inputs, quantised, std::move(whole));
}

}  // namespace

std::shared_ptr<const CodedHeights> codeEveryStep(const EncodeInputs& inputs,
                                                  const Quantised& quantised) {
  return drawnIfShorter(inputs, quantised, codeToTheLastBit(inputs, quantised));
}

/// A table is chosen by estimates. They miss heights that are smooth in multiples and not in places
/// of the table, such as squares of distances.
std::shared_ptr<const CodedHeights> codeLosslessHeights(const EncodeInputs& inputs,
                                                        const Quantised& quantised) {
  std::shared_ptr<const CodedHeights> coded = codeInItsSteps(inputs, quantised);
  if (quantised->steps.table.empty()) return coded;
  const Result<Quantised> multiples = quantiseInMultiples(inputs);
  if (!multiples.ok() || takesMore(inputs, **multiples, bytesOf(coded->tracks))) return coded;
  return fewestBytes<CodedHeights>({{coded}, {codeInItsSteps(inputs, *multiples)}},
                                   notingLonger(inputs))
      .coded;
}

}  // namespace tetrakis::inline ways
