// SPDX-License-Identifier: Apache-2.0
// The slopes at the end of heights that were coded for a bound tell little: the last bits of a
// coarse step, and corrections, take hardly anything off the squared error, and heights that vary
// less than the bound take no bytes at all. So the packets are put in the order of heights coded
// for as good a PSNR, whose slopes fall steadily as their error does.
#include "encoder/targets/beside_bound.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/portable_math.hpp"
#include "codec/geometry/quantiser/voids.hpp"
#include "encoder/heights/height_errors.hpp"
#include "encoder/heights/ways/heights_for_target.hpp"
#include "encoder/targets/heights_need.hpp"
#include "ratecontrol/needs/needed_bytes.hpp"

namespace tetrakis::inline targets {

namespace {

constexpr double kLeastPsnr = 0.1, kMostPsnr = 300;  // dB; 0 is no target
/// Heights beside a bound are coded for this PSNR at least, in dB, so that there are packets to
/// order. A larger number takes time; with a smaller one a coarse bound leaves packets too few.
constexpr double kOrderedPsnr = 30;

/// The PSNR of heights. Exact samples are as good as errors spread evenly within half of the step
/// that all of them are multiples of.
double psnrOf(const EncodeInputs& inputs, const CodedHeights& heights) {
  const HeightSteps& steps = heights.quantised->steps;
  const double least = steps.exact ? steps.step * steps.step / 12 : 0;
  const double squares =
      sampleErrorsOf(heights, codewordsOf(heights.tracks), inputs.options.threads).mean_square;
  const SampleRange range = rangeOf(*inputs.heights, steps.valid);
  const double peak = range.high - range.low;
  const double psnr = 10 * portable::log10(peak * peak / std::max(squares, least));
  return peak > 0 ? std::clamp(psnr, kLeastPsnr, kMostPsnr) : kLeastPsnr;
}

/// Codes the heights for a PSNR of at least kOrderedPsnr, so that there are packets to order; null
/// where the step that the caller gave is too coarse for this PSNR.
std::shared_ptr<const CodedHeights> codeForPsnr(const EncodeInputs& inputs,
                                                tks_encode_options options) {
  options.psnr = std::max(options.psnr, kOrderedPsnr);
  const EncodeInputs to_psnr = inputs.with(options, inputs.priorities);
  const Result<std::shared_ptr<const QuantisedHeights>> quantised = quantiseHeights(to_psnr);
  return quantised.ok() ? codeHeightsForTarget(to_psnr, *quantised) : nullptr;
}

}  // namespace

uint64_t textureBesideBound(const EncodeInputs& inputs, const Candidates& candidates) {
  tks_encode_options options = inputs.options;
  options.max_error = 0;
  options.psnr = psnrOf(inputs, *candidates.heights.coded);
  EncodeInputs to_psnr = inputs.with(options, inputs.priorities);
  to_psnr.notes = nullptr;  // these heights are no candidates
  const std::shared_ptr<const CodedHeights> heights = codeForPsnr(to_psnr, options);
  if (!heights) return kAllBytes;
  const Candidates both = withCurves(to_psnr, {{heights}, candidates.texture});
  const uint64_t need = heightsNeed(to_psnr, both.heights).value_or(kAllBytes);
  return sentWith(orderPackets(both).packets, Component::kGeometry, need)[1];
}

}  // namespace tetrakis::inline targets
