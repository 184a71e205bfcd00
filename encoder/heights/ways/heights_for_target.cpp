// SPDX-License-Identifier: Apache-2.0
// codeHeightsForTarget() branches by the target of the options; exactHeightsFor() makes exact
// heights for the targets that allow errors, to be compared with the others.
#include "encoder/heights/ways/ways.hpp"

#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "codec/geometry/coding_choice/cuts.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_encoder.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/heights/quantised_heights.hpp"

namespace tetrakis::inline ways {

namespace {

/// Exact heights are tried up to this many times the bytes, by an estimate. 14 DEMs take 0.88 to
/// 1.15 of the estimate: a larger factor takes time, a smaller one misses shorter heights.
constexpr double kClearlyMore = 1.4;
/// Estimates up to this many times as large again are tried by a cut: squares of distances take a
/// quarter by a cut. A larger factor takes the time of choosing more cuts.
constexpr double kMostByCut = 4;
/// Errors, in steps, up to which exact heights are tried for a largest error. A larger number takes
/// time for coarse bounds, within which rounded heights mostly are shorter.
constexpr double kMostSteps = 2;

}  // namespace

bool mayTakeNoMore(const EncodeInputs& inputs, const QuantisedHeights& heights, uint64_t bytes) {
  const HeightSteps& steps = heights.steps;
  const PlaneView<const int32_t> plane = steps.lifting(extentOf(*heights.samples));
  const double whole = typicalCost(plane, steps.range_bits, 0).bits / 8;
  const double most = kClearlyMore * static_cast<double>(bytes);
  if (whole <= most) return true;
  if (whole <= kMostByCut * most && steps.table.empty()) {
    const auto cut = chooseExactCut(plane, steps.range_bits, static_cast<uint64_t>(whole));
    if (cut && cut->bytes <= most) return true;
  }
  noteExpected(inputs, planOf(heights, Coding::kWavelet), whole);
  return false;
}

std::shared_ptr<const CodedHeights> exactHeightsFor(const EncodeInputs& inputs, double error,
                                                    uint64_t lossy_bytes) {
  assert(inputs.heights != nullptr && inputs.options.lossless == 0);
  tks_encode_options options = inputs.options;
  options.bytes = 0;
  options.psnr = options.max_error = 0;
  options.lossless = 1;
  const EncodeInputs lossless = inputs.with(options, inputs.priorities);
  const Result<std::shared_ptr<const QuantisedHeights>> heights = quantiseHeights(lossless);
  if (!heights.ok()) return nullptr;
  const HeightSteps& steps = (*heights)->steps;
  const PlaneView<const int32_t> plane(steps.steps, extentOf(*inputs.heights), steps.valid);
  const bool few = !steps.table.empty() || drawingMayFit(plane, lossy_bytes);
  if (few) return codeLosslessHeights(lossless, *heights);
  if (error < relativeStepOf(**heights)) return codeLosslessHeights(lossless, *heights);
  if (const auto facets = facetsOf(**heights); facets && mayFit(*facets, **heights, lossy_bytes))
    return codeLosslessHeights(lossless, *heights);
  if (error > kMostSteps * steps.step) return nullptr;
  if (!mayTakeNoMore(inputs, **heights, lossy_bytes)) return nullptr;
  return codeLosslessHeights(lossless, *heights);
}

namespace {

/// The part of a budget that heights get beside a texture whose size is not known yet, for filters
/// and flat areas; most of the budget is the texture's. A smaller number chooses for more bytes.
constexpr uint64_t kShareBesideTexture = 4;
/// The same part for the room of a late mask and the coefficients before it. A smaller number
/// delays the mask, so that small budgets hold heights without their voids.
constexpr uint64_t kMaskShareBesideTexture = 8;
/// Coding for a PSNR ends at the target's squared error over this number. A larger number takes
/// time; with a smaller one more heights miss the target and are coded once more.
constexpr double kPartOfTarget = 2;
/// Coding ends early only for targets above this squared error, in steps: below it the rounding of
/// samples counts as much. A smaller number has more heights coded twice.
constexpr double kLeastSquares = 1;

using Quantised = std::shared_ptr<const QuantisedHeights>;
using Heights = std::shared_ptr<const CodedHeights>;

/// Whether an error, in sample units, is too small for any steps but the exact ones: for coarser
/// multiples of them and, with floats, for any other step.
bool leavesExactSteps(const QuantisedHeights& heights, double error) {
  const bool any_step = heights.samples->sample == TKS_F32;
  return heights.steps.exact && !heights.restored() &&
         error < heights.steps.step / (any_step ? 2 : 1);
}

/// The room for coefficients before a late mask, so that the budget holds all of the mask. Where
/// the budget has no room for all of it, the mask may lie behind the budget.
MaskRoom maskRoomOf(const EncodeInputs& inputs, const QuantisedHeights& heights) {
  const uint64_t budget = inputs.options.bytes,
                 share = inputs.image == nullptr ? 1 : kMaskShareBesideTexture;
  const std::optional<uint64_t> room = roomBesideMask(heights.late.bytes(), budget);
  return {room ? *room / share : 0, budget / share};
}

/// Codes the heights within the largest error, or exactly where exact heights take fewer bytes.
Heights codeWithinBound(const EncodeInputs& inputs, Quantised quantised) {
  const double error = inputs.options.max_error / std::abs(inputs.heights->scale);
  if (leavesExactSteps(*quantised, error)) {
    if (Heights exact = exactHeightsFor(inputs, error, UINT64_MAX)) return exact;
  }
  Heights bounded = codeBoundedHeights(inputs, std::move(quantised));
  const uint64_t bytes = bytesOf(bounded->tracks);
  Heights exact = exactHeightsFor(inputs, error, bytes);
  if (!exact) return bounded;
  const bool shorter = bytesOf(exact->tracks) < bytes;
  note(inputs, shorter ? *bounded : *exact, Verdict::kLonger);
  return shorter ? exact : bounded;
}

/// Coding ends at a part of the target error: the account is not precise enough to end at the
/// target, and samples are rounded, which counts where few steps are left. If the samples then miss
/// the target, coding goes on.
CodedHeights codeUntilReached(const EncodeInputs& inputs, const Quantised& quantised,
                              HeightTarget target) {
  const SampleRange range = rangeOf(*inputs.heights, quantised->steps.valid);
  const double wanted =
      worstMeanSquare(range.high - range.low, inputs.options.psnr) / inputs.heaviest();
  target.mean_square = wanted / (quantised->steps.step * quantised->steps.step);
  CoefficientOptions options = heightOptions(inputs);
  if (target.mean_square > kLeastSquares && !quantised->restored())
    options.enough = target.mean_square / kPartOfTarget * quantised->counted();
  CodedHeights coded = codeHeights(quantised, target, options);
  if (coded.tracks.front().complete) return coded;
  const Codewords whole = codewordsOf(coded.tracks);
  if (sampleErrorsOf(coded, whole, options.threads).mean_square <= wanted) return coded;
  return codeHeights(quantised, target, heightOptions(inputs));
}

}  // namespace

Heights codeHeightsForTarget(const EncodeInputs& inputs, Quantised quantised) {
  if (inputs.options.max_error > 0) return codeWithinBound(inputs, std::move(quantised));
  if (inputs.options.lossless != 0) return codeLosslessHeights(inputs, quantised);
  HeightTarget target(quantised->restored() ? Purpose::kLossless : purposeOf(inputs));
  if (inputs.budgeted()) {
    target.bytes = inputs.options.bytes / (inputs.image == nullptr ? 1 : kShareBesideTexture);
    target.mask_room = maskRoomOf(inputs, *quantised);
  }
  if (inputs.options.psnr > 0)
    return std::make_shared<const CodedHeights>(codeUntilReached(inputs, quantised, target));
  return std::make_shared<const CodedHeights>(
      codeHeights(quantised, target, heightOptions(inputs)));
}

}  // namespace tetrakis::inline ways
