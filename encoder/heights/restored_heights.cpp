// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/restored_heights.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/geometry/height_layers.hpp"
#include "codec/geometry/relative/relative_encoder.hpp"
#include "codec/geometry/steps/height_samples.hpp"

namespace tetrakis::inline heights {

namespace {

/// What decoders make of all bytes.
HeightSteps decodedSteps(const CodedHeights& heights, uint32_t threads) {
  DecodedHeights decoded = decodeHeights(heights.header, heights.layers,
                                         codewordsOf(heights.tracks), {}, {threads, nullptr});
  HeightSteps shown;
  shown.steps = wholeSteps(std::move(decoded.geometry));
  shown.valid = heights.of->steps.valid;
  shown.base = heights.of->steps.base;
  shown.step = heights.of->steps.step;
  return shown;
}

/// What the tracks leave is left by the first one, whose corrections restore all samples.
void leaveAllToFirst(std::vector<EncodedTrack>& tracks) {
  RatePoint left{0, 0};
  for (size_t i = 1; i < tracks.size(); ++i) {
    const RatePoint last = tracks[i].points.back();
    for (RatePoint& point : tracks[i].points) {
      point.distortion -= last.distortion;
      point.beyond -= last.beyond;
    }
    left.distortion += last.distortion;
    left.beyond += last.beyond;
  }
  for (RatePoint& point : tracks.front().points) {
    point.distortion += left.distortion + QuantisedHeights::kInexact;
    point.beyond += left.beyond;
  }
}

/// The heights with corrections from a relative step behind what there is of their coefficients.
CodedHeights followedByRelative(CodedHeights cut, double relative_step, uint32_t threads) {
  const HeightSteps shown = decodedSteps(cut, threads);
  std::vector<uint8_t> corrections;
  for (const uint8_t quarters : {uint8_t{4}, uint8_t{1}}) {
    const RelativeSteps relative{relative_step, quarters};
    std::vector<uint8_t> tried = encodeRelative(
        *cut.of->samples, {shown.steps, cut.header.extent(), shown.valid}, cut.header, relative);
    if (!corrections.empty() && tried.size() >= corrections.size()) continue;
    corrections = std::move(tried);
    cut.layers.relative = relative;
  }
  leaveAllToFirst(cut.tracks);
  EncodedTrack& track = cut.tracks.front();
  cut.layers.corrections = CorrectionKind::kRelative;
  cut.layers.coefficient_bytes = track.codeword.size() - cut.layers.openingBytes();
  cut.closing = corrections.size();
  cut.left = QuantisedHeights::kInexact;
  track.codeword.insert(track.codeword.end(), corrections.begin(), corrections.end());
  track.points.push_back({track.codeword.size(), 0});
  return cut;
}

/// The mean squared error of the cut, in steps.
double squaresOfCut(const HeightSteps& steps, double relative_step) {
  const double rmse = kRelativeCut * relative_step / steps.step;
  return rmse * rmse;
}

}  // namespace

double relativeStepOf(const CodedHeights& lossy) {
  const QuantisedHeights& of = *lossy.of;
  const bool possible = !of.restored() && of.steps.table.empty() && !lossy.header.direct() &&
                        lossy.closing == 0 && lossy.tracks.size() == 1;
  return possible ? relativeStepOf(of) : 0;
}

std::optional<CodedHeights> codeRelative(const CodedHeights& lossy, double relative_step,
                                         uint32_t threads) {
  const double squares = squaresOfCut(lossy.of->steps, relative_step) * lossy.counted();
  const std::vector<RatePoint>& points = lossy.tracks.front().points;
  const auto end = std::find_if(points.begin(), points.end(), [&](const RatePoint& point) {
    return point.distortion <= squares;
  });
  if (end == points.end() || end->bytes < lossy.layers.openingBytes()) return {};
  CodedHeights cut = lossy;
  EncodedTrack& track = cut.tracks.front();
  track.codeword.resize(end->bytes);
  track.points.assign(points.begin(), end + 1);
  track.complete = false;
  return followedByRelative(std::move(cut), relative_step, threads);
}

CodedHeights codeRelative(const EncodeInputs& inputs,
                          const std::shared_ptr<const QuantisedHeights>& of, double relative_step) {
  HeightTarget target(Purpose::kLossy);
  target.mean_square = squaresOfCut(of->steps, relative_step);
  CoefficientOptions options = heightOptions(inputs);
  options.enough = target.mean_square * of->counted();
  return followedByRelative(codeHeights(of, target, options), relative_step,
                            inputs.options.threads);
}

bool canBeRestored(const CodedHeights& lossy) {
  const QuantisedHeights& of = *lossy.of;
  return !of.steps.exact && !of.restored() && of.steps.table.empty() && !lossy.header.direct() &&
         lossy.closing == 0 && lossy.tracks.size() == 1 && lossy.tracks.front().complete;
}

CodedHeights codeRestored(const EncodeInputs& inputs, const CodedHeights& lossy) {
  assert(canBeRestored(lossy));
  const HeightSteps shown = decodedSteps(lossy, inputs.options.threads);
  auto of = std::make_shared<QuantisedHeights>(*lossy.of);
  of->corrections = encodeCorrections(
      sampleCorrections(*of->samples, shown),
      {sampleHints(shown.steps, 0, lossy.header), lossy.header.extent(), shown.valid});
  of->layers.corrections = CorrectionKind::kSamples;
  of->left = std::max(of->squaresOf(shown), QuantisedHeights::kInexact);
  CodedHeights restored = lossy;
  EncodedTrack& track = restored.tracks.front();
  restored.layers.corrections = CorrectionKind::kSamples;
  restored.layers.coefficient_bytes = track.codeword.size() - lossy.layers.openingBytes();
  restored.closing = of->corrections.size();
  restored.left = of->left;
  track.codeword.insert(track.codeword.end(), of->corrections.begin(), of->corrections.end());
  for (RatePoint& point : track.points) point.distortion += of->left;
  track.points.push_back({track.codeword.size(), 0});
  restored.of = std::move(of);
  return restored;
}

}  // namespace tetrakis::inline heights
