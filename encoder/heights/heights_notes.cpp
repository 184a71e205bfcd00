// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/coded_heights.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace tetrakis::inline heights {

namespace {

/// The residual that corrections are.
Residual residualOf(const GeometryLayers& layers) {
  switch (layers.corrections) {
    case CorrectionKind::kNone:
      return {};
    case CorrectionKind::kSteps:
      if (layers.correction_step == 1) return {Residual::Kind::kExact, 0, Predictor::kNeighbours};
      return {Residual::Kind::kWithin, (layers.correction_step - 1.) / 2, Predictor::kDecoded};
    case CorrectionKind::kSamples:
      return {Residual::Kind::kExact, 0, Predictor::kDecoded};
    case CorrectionKind::kRelative:
      return {Residual::Kind::kExact, 0, Predictor::kRelative};
    case CorrectionKind::kFacets:
      return {Residual::Kind::kExact, 0, Predictor::kFacets};
  }
  return {};
}

std::vector<Layer> layersOf(const GeometryLayers& stated) {
  std::vector<Layer> layers;
  if (stated.late_mask) {
    layers.push_back(Layer::kLateMask);
  } else if (stated.validity_bytes > 0) {
    layers.push_back(Layer::kMask);
  }
  if (stated.bridge > 0) layers.push_back(Layer::kBridges);
  if (stated.flat_areas > 0) layers.push_back(Layer::kFlatAreas);
  return layers;
}

/// The squared error, in steps, that the tracks leave by their accounts.
double squaresLeft(std::span<const EncodedTrack> tracks) {
  double squares = 0;
  for (const EncodedTrack& track : tracks) squares += track.points.back().distortion;
  return squares;
}

/// The RMSE, in steps, at which coefficients end ahead of corrections; nothing if they are complete
/// or nothing follows them.
std::optional<double> cutOf(const CodedHeights& coded) {
  const std::span<const EncodedTrack> tracks = coded.tracks;
  const auto corrections = static_cast<size_t>(correctionTracks(coded.header, coded.layers));
  const std::span<const EncodedTrack> base = tracks.first(tracks.size() - corrections);
  const auto complete = [](const EncodedTrack& track) { return track.complete; };
  if (!coded.hasCorrections() || std::all_of(base.begin(), base.end(), complete)) return {};
  double squares = 0;
  for (const EncodedTrack& track : tracks.subspan(base.size()))
    squares += track.points.front().distortion;
  if (corrections > 0) {
    squares += squaresLeft(base);
  } else {
    const EncodedTrack& track = base.front();
    squares += distortionAt(track.points, track.codeword.size() - coded.correction_bytes);
  }
  return std::sqrt(std::max(squares - coded.left, 0.) / coded.counted());
}

/// Notes the same plan with flat areas if the heights have none, or without them, where an estimate
/// of both has decided.
void noteFlatChoice(const EncodeInputs& inputs, const CodedHeights& coded) {
  if (!coded.flat.ratio || coded.hasCorrections()) return;
  Plan other = planOf(coded);
  other.filters.reset();
  const auto bytes = static_cast<double>(bytesOf(coded.tracks));
  const auto at = std::lower_bound(other.layers.begin(), other.layers.end(), Layer::kFlatAreas);
  const bool is_flat = at != other.layers.end() && *at == Layer::kFlatAreas;
  if (is_flat) {
    other.layers.erase(at);
  } else {
    other.layers.insert(at, Layer::kFlatAreas);
  }
  noteExpected(inputs, std::move(other),
               is_flat ? bytes / *coded.flat.ratio : bytes * *coded.flat.ratio);
}

}  // namespace

Plan planOf(const QuantisedHeights& quantised, Coding base) {
  GeometryLayers layers = quantised.layers;
  if (base != Coding::kWavelet) layers.bridge = 0;
  const bool table = !quantised.table.empty() && base != Coding::kStored;
  return {.base = base,
          .step = table || base == Coding::kStored ? 0 : quantised.steps.step,
          .table_values = table ? layers.table_values : 0,
          .layers = layersOf(layers)};
}

Plan planOf(const CodedHeights& coded) {
  Plan plan = planOf(*coded.quantised, coded.header.coding());
  plan.layers = layersOf(coded.layers);
  plan.residual = residualOf(coded.layers);
  if (coded.header.direct()) return plan;
  plan.filters = coded.header.wavelet.filters;
  plan.fractions = coded.header.wavelet.fraction_bits > 0;
  plan.cut = cutOf(coded);
  if (!coded.header.priorities.none()) plan.layers.push_back(Layer::kPriorities);
  if (coded.header.regions.side_log2 > 0) plan.layers.push_back(Layer::kRegions);
  return plan;
}

void note(const EncodeInputs& inputs, const CodedHeights& coded, Verdict verdict, uint64_t need) {
  if (inputs.notes == nullptr) return;
  const double unit = coded.quantised->steps.step;
  const double rmse = std::sqrt(std::max(squaresLeft(coded.tracks), 0.) / coded.counted()) * unit;
  const uint64_t bytes = bytesOf(coded.tracks);
  const CodedOutcome outcome{bytes, std::min(need, bytes), coded.inHeader(), rmse};
  inputs.notes->heights.add({planOf(coded), verdict, coded.expected, outcome});
  noteFlatChoice(inputs, coded);
}

void noteExpected(const EncodeInputs& inputs, Plan plan, double bytes) {
  if (inputs.notes == nullptr || !std::isfinite(bytes)) return;
  inputs.notes->heights.add({std::move(plan), Verdict::kExpectedLonger, bytes});
}

}  // namespace tetrakis::inline heights
