// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/quantised_heights.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/geometry/quantiser/stand_in_choice.hpp"
#include "codec/geometry/quantiser/step_choice.hpp"
#include "codec/geometry/quantiser/step_errors.hpp"
#include "codec/geometry/relative/relative_step_choice.hpp"
#include "codec/geometry/steps/height_samples.hpp"
#include "codec/geometry/values/value_table_encoder.hpp"
#include "lattice/validity_encoder.hpp"

namespace tetrakis::inline heights {

namespace {

/// Chosen for the target, and whether corrections are to restore what they do not show.
struct ChosenSteps {
  HeightSteps steps;
  bool restore = false;
};

Result<ChosenSteps> chooseSteps(const EncodeInputs& inputs) {
  const tks_heights& heights = *inputs.heights;
  const double error = inputs.options.max_error / std::abs(heights.scale);
  const bool lossless = inputs.options.lossless != 0;
  Result<HeightSteps> steps = toSteps(heights, {.given = heights.step,
                                                .lossless = lossless,
                                                .table = lossless,
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

void addValidity(QuantisedHeights& heights) {
  const tks_heights& samples = *heights.samples;
  const bool infinite_integer = samples.sample != TKS_F32 && !std::isfinite(samples.nodata);
  GeometryLayers& layers = heights.layers;
  layers.has_nodata = samples.has_nodata != 0 && !std::isnan(samples.nodata) && !infinite_integer;
  if (layers.has_nodata) layers.nodata = samples.nodata + 0.0;  // -0 equals 0: one of them
  if (heights.steps.valid.empty()) return;
  heights.validity = encodeValidity({heights.steps.valid, extentOf(samples)});
  layers.validity_bytes = heights.validity.size();
}

void addTable(QuantisedHeights& heights) {
  const ValueTable& table = heights.steps.table;
  if (table.empty()) return;
  heights.table = encodeValueTable(table);
  heights.layers.table_bytes = heights.table.size();
  heights.layers.table_values = static_cast<uint32_t>(table.words.size());
  StandInChoice stand_in = chooseStandIn(heights.steps, headerOf(heights), heights.table.size(),
                                         heights.mostOfASample());
  heights.layers.table_knots = std::move(stand_in.knots);
  heights.without_table = std::max(stand_in.squares, QuantisedHeights::kInexact);
}

/// What restores the samples behind the steps.
void addCorrections(QuantisedHeights& heights) {
  const tks_heights& samples = *heights.samples;
  heights.layers.corrections = CorrectionKind::kSamples;
  const GeometryHeader header = headerOf(heights);
  const std::vector<uint8_t> hints = sampleHints(decodedSteps(heights.steps, header), 0, header);
  heights.corrections = encodeCorrections(sampleCorrections(samples, heights.steps),
                                          {hints, header.extent(), heights.steps.valid});
  heights.left = std::max(heights.squaresOf(heights.steps), QuantisedHeights::kInexact);
}

/// The samples as these steps, and which are valid.
QuantisedHeights asSteps(const EncodeInputs& inputs, HeightSteps steps) {
  QuantisedHeights heights;
  heights.samples = inputs.heights;
  heights.shown_by = inputs.shownBy();
  heights.steps = std::move(steps);
  addValidity(heights);
  return heights;
}

}  // namespace

double QuantisedHeights::counted() const {
  return static_cast<double>(std::max<size_t>(steps.validCount(), 1));
}

double QuantisedHeights::validityWorth() const {
  return std::exp2(2.0 * steps.range_bits - 4);
}

double QuantisedHeights::mostOfASample() const {
  return std::exp2(2.0 * steps.range_bits + 4);
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

double relativeStepOf(const QuantisedHeights& heights) {
  constexpr double kCoarser = 8;
  const HeightSteps& steps = heights.steps;
  if (heights.samples->step > 0) return 0;
  const double relative = findRelativeStep(*heights.samples, steps.valid);
  const bool table = !steps.table.empty();
  return table || relative >= kCoarser * steps.step ? relative : 0;
}

Result<std::shared_ptr<const QuantisedHeights>> quantiseHeights(const EncodeInputs& inputs) {
  assert(inputs.heights != nullptr);
  Result<ChosenSteps> chosen = chooseSteps(inputs);
  if (!chosen.ok()) return chosen.status();
  auto heights = std::make_shared<QuantisedHeights>(asSteps(inputs, std::move(chosen->steps)));
  addTable(*heights);
  if (chosen->restore && !heights->steps.exact) addCorrections(*heights);
  assert(heights->restored() || heights->corrections.empty());
  return std::shared_ptr<const QuantisedHeights>(std::move(heights));
}

std::shared_ptr<const QuantisedHeights> quantiseForRelative(const EncodeInputs& inputs,
                                                            double relative_step) {
  constexpr double kFine = 1. / 8;  // of the relative step
  Result<HeightSteps> steps = toSteps(*inputs.heights, {.leave_outliers = true});
  if (!steps.ok() || steps->step > kFine * relative_step) return nullptr;
  return std::make_shared<const QuantisedHeights>(asSteps(inputs, *std::move(steps)));
}

GeometryHeader headerOf(const QuantisedHeights& heights) {
  GeometryHeader header;
  header.width = heights.samples->width;
  header.height = heights.samples->height;
  header.sample = static_cast<uint8_t>(heights.samples->sample);
  header.exact = heights.steps.exact;
  header.base = heights.steps.base;
  header.step = heights.steps.step;
  return header;
}

}  // namespace tetrakis::inline heights
