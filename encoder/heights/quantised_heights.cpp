// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/quantised_heights.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/portable_math.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/geometry/quantiser/step_choice.hpp"
#include "codec/geometry/quantiser/value_choice.hpp"
#include "codec/geometry/relative/relative_encoder.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/values/value_table.hpp"
#include "codec/lattice/validity.hpp"

namespace tetrakis::inline heights {

namespace {

/// log2 of the squared error of a sample of unknown validity, and of the largest error of a sample,
/// over the squared range. With more, masks come earlier among the coefficients, and exceptions
/// weigh more beside all other samples.
constexpr double kValidityLog2 = -4, kSampleLog2 = 4;
/// A relative step beside exact steps is tried if it is this many times as wide. A smaller factor
/// takes the time of another way of coding where exact steps mostly win.
constexpr double kCoarser = 8;
/// The part of a relative step that the step of coefficients may have. A larger part tries relative
/// steps where the cut cannot come near to their multiples.
constexpr double kFine = 1. / 4;

/// Steps that suit the target, and whether corrections are to restore the samples that the steps do
/// not show.
struct ChosenSteps {
  HeightSteps steps;
  bool restore = false;
};

Result<ChosenSteps> chooseSteps(const EncodeInputs& inputs, bool table) {
  const tks_heights& heights = *inputs.heights;
  const double error = inputs.options.max_error / std::abs(heights.scale);
  const bool lossless = inputs.options.lossless != 0;
  Result<HeightSteps> steps = toSteps(heights, {.given = heights.step,
                                                .lossless = lossless,
                                                .table = table && lossless,
                                                .error = error,
                                                .leave_outliers = inputs.budgeted()});
  if (!steps.ok()) return steps.status();
  const bool too_coarse = error > 0 && errorsOf(heights, *steps).largest > error;
  if (!too_coarse) return ChosenSteps{std::move(*steps), lossless};
  if (heights.step > 0) {
    return Status(TKS_USAGE,
                  "The maximum error is below what the step of these heights allows; give a "
                  "smaller step.");
  }
  steps = toSteps(heights, {.lossless = true});
  if (!steps.ok()) return steps.status();
  return ChosenSteps{std::move(*steps), true};
}

/// The layers that the header states of heights with voids. validity_bytes: 0 if there are no
/// voids.
GeometryLayers layersOf(const tks_heights& samples, uint64_t validity_bytes) {
  const bool has_nodata = statesNodata(samples);
  return {.validity_bytes = validity_bytes,
          .has_nodata = has_nodata,
          .nodata = has_nodata ? samples.nodata + 0.0 : 0};  // -0 equals 0: one of them
}

/// The target for which bridges over voids are chosen.
BridgeTarget bridgeTarget(const EncodeInputs& inputs, const HeightSteps& steps) {
  const tks_encode_options& options = inputs.options;
  if (options.lossless != 0) return {Purpose::kLossless};
  if (inputs.budgeted()) return {Purpose::kLossy, options.bytes};
  const double squared_step = steps.step * steps.step;
  if (options.max_error > 0) {
    const double error = options.max_error / inputs.heights->scale;
    return {Purpose::kLossy, UINT64_MAX, error * error / squared_step / 3};  // if it is even
  }
  const SampleRange range = rangeOf(*inputs.heights, steps.valid);
  return {Purpose::kLossy, UINT64_MAX,
          worstMeanSquare(range.high - range.low, options.psnr) / squared_step};
}

QuantisedHeights withoutTable(const EncodeInputs& inputs, HeightSteps steps, BridgeTarget target) {
  const tks_heights& samples = *inputs.heights;
  std::vector<uint8_t> validity;
  if (!steps.valid.empty()) validity = encodeValidity({steps.valid, extentOf(samples)});
  LateMask late;
  target.preferred = [&, valid = steps.valid](const std::vector<uint8_t>& lifted) {
    late = lateMaskOf({valid, extentOf(samples)}, lifted, validity.size(), target);
    return !late.none();
  };
  if (target.bytes < UINT64_MAX) {
    const uint64_t room = roomBesideMask(validity.size(), target.bytes).value_or(0);
    target.needed = room < besideMaskAtLeast(target.bytes);
    if (!target.needed) target.bytes -= validity.size();
  }
  const SharedForest forest = forestOf(samples);
  if (forest != nullptr) {
    steps.patch_rows = forest->side();
    steps.owned = ownedSamples(*forest).bytes();
  }
  steps = withBridgesFor(target, std::move(steps), extentOf(samples));
  GeometryLayers layers = layersOf(samples, validity.size());
  layers.bridge = steps.bridge;
  return {.samples = &samples,
          .steps = std::move(steps),
          .layers = std::move(layers),
          .validity = std::move(validity),
          .late = std::move(late),
          .shown_by = inputs.shownBy(),
          .forest = forest};
}

/// The heights with the table of their values, if they have one.
QuantisedHeights withTable(QuantisedHeights heights) {
  const ValueTable& table = heights.steps.table;
  if (table.empty()) return heights;
  heights.table = encodeValueTable(table);
  heights.layers.table_bytes = heights.table.size();
  heights.layers.table_values = static_cast<uint32_t>(table.words.size());
  StandInChoice stand_in = chooseStandIn(heights.steps, headerOf(heights), heights.table.size(),
                                         heights.mostOfASample());
  heights.layers.table_knots = std::move(stand_in.knots);
  heights.without_table = std::max(stand_in.squares, QuantisedHeights::kInexact);
  return heights;
}

/// Quantises the heights. table: whether a table of their values may take the place of multiples.
Result<std::shared_ptr<const QuantisedHeights>> quantise(const EncodeInputs& inputs, bool table) {
  assert(inputs.heights != nullptr);
  Result<ChosenSteps> chosen = chooseSteps(inputs, table);
  if (!chosen.ok()) return chosen.status();
  if (inputs.heights->domain == TKS_DOMAIN_FOREST && !chosen->steps.valid.empty())
    return Status(TKS_USAGE, "Heights on a forest have no voids; fill them first.");
  const BridgeTarget bridges = bridgeTarget(inputs, chosen->steps);
  QuantisedHeights heights = withTable(withoutTable(inputs, std::move(chosen->steps), bridges));
  if (chosen->restore && !heights.steps.exact) {
    const int region_log2 = heightOptions(inputs).region_log2;
    SampleCorrections corrections =
        correctionsBehind(heights, heights.steps, region_log2, inputs.options.threads);
    heights = withCorrections(std::move(heights), std::move(corrections));
  } else if (!heights.steps.exact) {
    heights.left = heights.squaresOf(heights.steps);
  }
  assert(heights.restored() || heights.corrections.empty());
  return std::make_shared<const QuantisedHeights>(std::move(heights));
}

}  // namespace

double QuantisedHeights::counted() const {
  return static_cast<double>(std::max<size_t>(steps.validCount(), 1));
}

double QuantisedHeights::validityWorth() const {
  return portable::exp2(2.0 * steps.range_bits + kValidityLog2);
}

double QuantisedHeights::mostOfASample() const {
  return portable::exp2(2.0 * steps.range_bits + kSampleLog2);
}

double QuantisedHeights::squaresOf(const HeightSteps& other) const {
  const double unit = other.step * other.step;
  return errorsOf(*samples, other, {mostOfASample() * unit}).squares / unit;
}

double QuantisedHeights::squaresOf(DecodedHeights decoded,
                                   const std::vector<uint8_t>& valid) const {
  if (steps.table.empty()) decoded.corrections.clear();
  const double unit = steps.step * steps.step;
  const double squares =
      squaresOfSamples(*samples, decoded, valid, steps, {mostOfASample() * unit, shown_by});
  if (shown_by.empty()) return squares / unit;
  const double all = std::accumulate(shown_by.begin(), shown_by.end(), 0.);
  return squares / unit * (static_cast<double>(shown_by.size()) / all);
}

Result<std::shared_ptr<const QuantisedHeights>> quantiseHeights(const EncodeInputs& inputs) {
  return quantise(inputs, true);
}

Result<std::shared_ptr<const QuantisedHeights>> quantiseInMultiples(const EncodeInputs& inputs) {
  return quantise(inputs, false);
}

double relativeStepOf(const QuantisedHeights& heights) {
  const HeightSteps& steps = heights.steps;
  if (heights.samples->step > 0) return 0;
  const double relative = findRelativeStep(*heights.samples, steps.valid);
  const bool on_grid = steps.exact && steps.table.empty();
  return !on_grid || relative >= kCoarser * steps.step ? relative : 0;
}

std::shared_ptr<const QuantisedHeights> quantiseForRelative(const EncodeInputs& inputs,
                                                            double relative_step) {
  Result<HeightSteps> steps = toSteps(*inputs.heights, {.leave_outliers = true});
  if (!steps.ok() || steps->step > kFine * relative_step) return nullptr;
  const double rmse = kRelativeCut * relative_step / steps->step;
  return std::make_shared<const QuantisedHeights>(
      withoutTable(inputs, *std::move(steps), {Purpose::kLossy, UINT64_MAX, rmse * rmse}));
}

std::shared_ptr<const QuantisedHeights> quantiseForFacets(const EncodeInputs& inputs) {
  Result<HeightSteps> steps = toSteps(*inputs.heights, {.leave_outliers = true});
  if (!steps.ok()) return nullptr;
  return std::make_shared<const QuantisedHeights>(
      withoutTable(inputs, *std::move(steps), {Purpose::kLossy}));
}

SampleCorrections correctionsBehind(const QuantisedHeights& heights, const HeightSteps& shown,
                                    int region_log2, uint32_t threads) {
  GeometryHeader header = headerOf(heights);
  header.regions.side_log2 = static_cast<uint8_t>(region_log2);
  const std::vector<uint8_t> hints = sampleHints(decodedSteps(shown, header), 0, header);
  const std::vector<int32_t> corrections = sampleCorrections(*heights.samples, shown);
  PartCodewords codewords = encodeParts(header, threads, [&](const Window& part) {
    const WindowValues<int32_t> of_part(corrections, header.extent(), part);
    const WindowValues<uint8_t> hints_there(hints, header.extent(), part);
    const WindowValues<uint8_t> valid(shown.valid, header.extent(), part);
    return encodeCorrections(of_part.values(),
                             {hints_there.values(), part.extent(), valid.values()});
  });
  return {std::move(codewords), std::max(heights.squaresOf(shown), QuantisedHeights::kInexact)};
}

QuantisedHeights withCorrections(QuantisedHeights heights, SampleCorrections corrections) {
  heights.layers.corrections = CorrectionKind::kSamples;
  heights.corrections = std::move(corrections.codewords);
  heights.left = corrections.left;
  return heights;
}

GeometryHeader headerOf(const QuantisedHeights& heights) {
  GeometryHeader header;
  header.width = heights.samples->width;
  header.height = heights.samples->height;
  header.sample = static_cast<uint8_t>(heights.samples->sample);
  header.exact = heights.steps.exact;
  header.base = heights.steps.base;
  header.step = heights.steps.step;
  header.wavelet.ring = heights.samples->domain == TKS_DOMAIN_CYLINDER;
  assert((heights.forest != nullptr) == (heights.steps.patch_rows > 0));
  header.wavelet.forest = heights.forest;
  return header;
}

}  // namespace tetrakis::inline heights
