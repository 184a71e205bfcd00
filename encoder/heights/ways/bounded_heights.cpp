// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/ways/ways.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "codec/geometry/coding_choice/cuts.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/geometry/quantiser/step_choice.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/heights/quantised_heights.hpp"
#include "ratecontrol/needs/needs.hpp"

namespace tetrakis::inline ways {

namespace {

/// Multiples of the exact step are preferred to the widest step if they are this many times as
/// wide. A larger factor tries floats of the widest step more often, which takes time.
constexpr double kClearlyWider = 1.02;
/// Errors below this many steps ask for coefficients to the last bit. A larger number takes bytes
/// that the bound does not ask for; with a smaller one fraction bits are lost that it asks for.
constexpr double kFewSteps = 2;
constexpr double kMostRounded = 1 << 24;  // twice as many steps, and one, fit the range of 2^26
constexpr double kSlack = 1e-9;           // a bound of whole steps is rounded by less

using Quantised = std::shared_ptr<const QuantisedHeights>;

/// The inputs that all attempts share.
struct Bound {
  const EncodeInputs& inputs;
  Quantised quantised;
  Purpose purpose;        ///< of coefficients that will be cut
  WaveletHeader wavelet;  ///< that suits them where nothing is flat
  CoefficientOptions options;
  double error;  ///< the largest one wanted, in sample units, less the rounding error of floats
};

/// The distance from the largest sample to the next float; 0 for integers, which are exact.
double floatSpacing(const QuantisedHeights& heights) {
  if (heights.samples->sample != TKS_F32) return 0;
  const SampleRange range = rangeOf(*heights.samples, heights.steps.valid);
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  return std::ldexp(1.0, spacingExponent(static_cast<float>(largest)));
}

/// Codes the same heights in other steps, and these exactly.
Candidate<CodedHeights> codeRounded(const Bound& bound, HeightSteps steps) {
  assert(!bound.quantised->restored());
  const QuantisedHeights& quantised = *bound.quantised;
  const tks_heights& samples = *quantised.samples;
  const uint8_t bridge = quantised.steps.bridge;
  steps.patch_rows = quantised.steps.patch_rows;
  steps.owned = quantised.steps.owned;
  QuantisedHeights rounded{.samples = &samples,
                           .steps = withBridges(std::move(steps), extentOf(samples), bridge),
                           .layers = quantised.layers,
                           .validity = quantised.validity,
                           .late = quantised.late,
                           .shown_by = quantised.shown_by,
                           .forest = quantised.forest};
  if (!rounded.steps.exact) rounded.left = rounded.squaresOf(rounded.steps);
  return {
      codeEveryStep(bound.inputs, std::make_shared<const QuantisedHeights>(std::move(rounded)))};
}

/// Floats whose step is not given, rounded to the widest step that the bound allows. Nothing if no
/// step is wider than the exact one, or if multiples of the exact step are clearly wider.
std::optional<Candidate<CodedHeights>> widen(const Bound& bound, int32_t largest) {
  const tks_heights& samples = *bound.quantised->samples;
  const double widest = 2 * bound.error, exact = bound.quantised->steps.step;
  if (samples.sample != TKS_F32 || samples.step > 0 || widest <= exact) return {};
  if ((2.0 * largest + 1) * exact > kClearlyWider * widest) return {};
  Result<HeightSteps> wide = toSteps(samples, {.given = widest});
  if (!wide.ok()) return {};
  return codeRounded(bound, std::move(*wide));
}

/// Floats rounded to multiples of a unit near which all of them lie; nothing if there is no unit of
/// this kind.
std::optional<Candidate<CodedHeights>> onNearGrid(const Bound& bound) {
  const tks_heights& samples = *bound.quantised->samples;
  if (samples.sample != TKS_F32 || samples.step > 0) return {};
  const auto unit = nearGrid(samples, bound.quantised->steps.valid, bound.error);
  if (!unit) return {};
  Result<HeightSteps> steps = toSteps(samples, {.given = *unit});
  if (!steps.ok()) return {};
  return codeRounded(bound, std::move(*steps));
}

/// Rounds to multiples of the exact step.
Candidate<CodedHeights> round(const Bound& bound, int32_t largest) {
  HeightSteps steps = bound.quantised->steps;
  if (largest > 0) {
    for (int32_t& q : steps.steps) q = nearestMultiple(q, largest);
    steps.step *= 2 * largest + 1;
    steps.exact = false;
    steps.range_bits = std::max(steps.range_bits - std::ilogb(2 * largest + 1), 1);
  }
  return codeRounded(bound, std::move(steps));
}

uint64_t fewestOf(const std::vector<Candidate<CodedHeights>>& made) {
  uint64_t fewest = UINT64_MAX;
  for (const auto& one : made) fewest = std::min(fewest, one.bytes());
  return fewest;
}

/// Notes the way that typical parts have ruled out.
void noteRuledOut(const Bound& bound, const BoundWays& ways, int32_t largest) {
  Plan plan = planOf(*bound.quantised, Coding::kWavelet);
  if (!ways.round && ways.rounded_bytes) {
    plan.step *= 2 * largest + 1;
    noteExpected(bound.inputs, std::move(plan), *ways.rounded_bytes);
  } else if (!ways.correct && ways.corrected_bytes) {
    plan.cut = std::sqrt(ways.mean_square.value_or(0));
    plan.residual = {Residual::Kind::kWithin, static_cast<double>(largest), Predictor::kDecoded};
    noteExpected(bound.inputs, std::move(plan), *ways.corrected_bytes);
  }
}

/// The candidate, which was expected to take `bytes` bytes.
Candidate<CodedHeights> expecting(std::optional<double> bytes,
                                  const Candidate<CodedHeights>& candidate) {
  if (!bytes) return candidate;
  CodedHeights coded = *candidate.coded;
  coded.expected = bytes;
  return candidateOf(std::move(coded));
}

/// Makes all attempts at a largest error in steps, whether or not they keep it.
std::vector<Candidate<CodedHeights>> attempts(const Bound& bound, int32_t largest) {
  const tks_heights& samples = *bound.quantised->samples;
  // In regions nobody searches for the cut, so that parts choose it whatever the size.
  const auto choose = bound.options.region_log2 > 0 && largest > 0 ? boundWaysByParts : boundWays;
  const BoundWays ways = choose(bound.quantised->steps, extentOf(samples), bound.wavelet, largest);
  noteRuledOut(bound, ways, largest);
  std::vector<Candidate<CodedHeights>> made;
  if (ways.round) {
    std::optional<Candidate<CodedHeights>> wide = widen(bound, largest);
    made.push_back(expecting(ways.rounded_bytes, wide ? *wide : round(bound, largest)));
  }
  if (ways.correct) {
    CodedHeights corrected = codeCorrected({bound.quantised, bound.purpose, bound.options, largest},
                                           {ways.mean_square, fewestOf(made)});
    corrected.expected = ways.corrected_bytes;
    made.push_back(candidateOf(std::move(corrected)));
  }
  return made;
}

/// Whether the heights keep the bound. Heights that do not keep it are noted.
bool keepsBound(const EncodeInputs& inputs, const CodedHeights& coded) {
  const SampleErrors errors =
      sampleErrorsOf(coded, codewordsOf(coded.tracks), inputs.options.threads);
  const bool keeps = errors.largest * std::abs(inputs.heights->scale) <= inputs.options.max_error;
  if (!keeps) note(inputs, coded, Verdict::kMissesTarget);
  return keeps;
}

/// Appends the shortest attempt that keeps the bound, if there is one, to those kept. Returns
/// whether no attempt is shorter: longer ones need not be looked at.
bool keepShortest(const EncodeInputs& inputs, std::vector<Candidate<CodedHeights>> made,
                  std::vector<Candidate<CodedHeights>>& kept) {
  std::stable_sort(made.begin(), made.end(),
                   [](const auto& a, const auto& b) { return a.bytes() < b.bytes(); });
  const auto keeps = [&](const auto& one) { return keepsBound(inputs, *one.coded); };
  const auto shortest = std::find_if(made.begin(), made.end(), keeps);
  if (shortest == made.end()) return made.empty();
  kept.push_back(*shortest);
  for (auto one = shortest + 1; one != made.end(); ++one)
    note(inputs, *one->coded, Verdict::kLonger);
  return shortest == made.begin();
}

}  // namespace

/// Exact steps leave an error of their own; the coding may use the rest of the bound in whole
/// steps. Where floats are then rounded beyond the bound, one step less suffices; the exact steps,
/// no error at all, are always within the bound.
std::shared_ptr<const CodedHeights> codeBoundedHeights(const EncodeInputs& inputs,
                                                       Quantised quantised) {
  const double wanted = inputs.options.max_error / std::abs(inputs.heights->scale);
  assert(wanted > 0);
  const CoefficientOptions options = heightOptions(inputs);
  const auto exactly = [&] {
    return candidateOf(codeHeights(quantised, Purpose::kLossless, options)).coded;
  };
  if (quantised->restored()) return codeLosslessHeights(inputs, quantised);
  const double finest = quantised->steps.step * std::abs(inputs.heights->scale);
  const bool fine = inputs.options.max_error < kFewSteps * finest;
  const Purpose purpose = fine ? Purpose::kLossless : Purpose::kLossy;
  const Bound bound{inputs,  quantised,
                    purpose, chooseHeightFilters(*quantised, purpose),
                    options, wanted - floatSpacing(*quantised) / 2};
  const double room =
      (wanted - errorsOf(*inputs.heights, quantised->steps).largest) / quantised->steps.step;
  const auto largest = static_cast<int32_t>(std::clamp(room + kSlack, 0.0, kMostRounded));
  std::vector<Candidate<CodedHeights>> kept;
  const std::optional<Candidate<CodedHeights>> near = onNearGrid(bound);
  if (near && keepsBound(inputs, *near->coded)) kept.push_back(*near);
  for (const int32_t tried : {largest, std::max(largest - 1, 0), 0}) {
    if (tried == 0 && !kept.empty()) break;
    if (keepShortest(inputs, attempts(bound, tried), kept)) break;
  }
  if (kept.empty()) return exactly();
  const std::shared_ptr<const CodedHeights> best =
      fewestBytes(std::move(kept), notingLonger(inputs)).coded;
  return std::make_shared<const CodedHeights>(withRounding(*best));
}

}  // namespace tetrakis::inline ways
