// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/relative_heights.hpp"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "codec/geometry/relative/relative_encoder.hpp"
#include "encoder/heights/height_options.hpp"
#include "encoder/heights/restored_heights.hpp"

namespace tetrakis::inline heights {

namespace {

/// The mean squared error of the cut, in steps.
double squaresOfCut(const HeightSteps& steps, double relative_step) {
  const double rmse = kRelativeCut * relative_step / steps.step;
  return rmse * rmse;
}

/// The tracks with the corrections behind the first one, which then leaves what all of them leave,
/// until the corrections restore all samples.
std::vector<EncodedTrack> tracksWithCorrections(std::vector<EncodedTrack> tracks,
                                                const std::vector<uint8_t>& corrections) {
  RatePoint left{0, QuantisedHeights::kInexact};
  for (size_t i = 1; i < tracks.size(); ++i) {
    const RatePoint last = tracks[i].points.back();
    for (RatePoint& point : tracks[i].points) {
      point.distortion -= last.distortion;
      point.beyond -= last.beyond;
    }
    left.distortion += last.distortion;
    left.beyond += last.beyond;
  }
  EncodedTrack& first = tracks.front();
  for (RatePoint& point : first.points) {
    point.distortion += left.distortion;
    point.beyond += left.beyond;
  }
  first.codeword.insert(first.codeword.end(), corrections.begin(), corrections.end());
  first.points.push_back({first.codeword.size(), 0});
  return tracks;
}

/// The corrections behind what there is of the coefficients, and the pull that makes them short.
struct RelativeCorrections {
  RelativeSteps relative;
  std::vector<uint8_t> codeword;
};

RelativeCorrections relativeCorrections(const CodedHeights& cut, double relative_step,
                                        uint32_t threads) {
  const HeightSteps shown = shownSteps(cut, threads);
  const auto pulled = [&](uint8_t quarters) {
    const RelativeSteps relative{relative_step, quarters};
    return RelativeCorrections{
        relative, encodeRelative(*cut.of->samples, {shown.steps, cut.header.extent(), shown.valid},
                                 cut.header, relative)};
  };
  RelativeCorrections all = pulled(4), quarter = pulled(1);
  return quarter.codeword.size() < all.codeword.size() ? std::move(quarter) : std::move(all);
}

CodedHeights followedByCorrections(CodedHeights cut, double relative_step, uint32_t threads) {
  const RelativeCorrections corrections = relativeCorrections(cut, relative_step, threads);
  GeometryLayers layers = cut.layers;
  layers.corrections = CorrectionKind::kRelative;
  layers.relative = corrections.relative;
  layers.coefficient_bytes = cut.tracks.front().codeword.size() - layers.openingBytes();
  return {.of = cut.of,
          .header = cut.header,
          .layers = std::move(layers),
          .tracks = tracksWithCorrections(std::move(cut.tracks), corrections.codeword),
          .closing = corrections.codeword.size(),
          .left = QuantisedHeights::kInexact,
          .flat = std::move(cut.flat)};
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
  const auto end = std::find_if(points.begin(), points.end(),
                                [&](const RatePoint& p) { return p.distortion <= squares; });
  if (end == points.end() || end->bytes < lossy.layers.openingBytes()) return {};
  CodedHeights cut = lossy;
  EncodedTrack& track = cut.tracks.front();
  track.codeword.resize(end->bytes);
  track.points.assign(points.begin(), end + 1);
  track.complete = false;
  return followedByCorrections(std::move(cut), relative_step, threads);
}

CodedHeights codeRelative(const EncodeInputs& inputs,
                          const std::shared_ptr<const QuantisedHeights>& of, double relative_step) {
  HeightTarget target(Purpose::kLossy);
  target.mean_square = squaresOfCut(of->steps, relative_step);
  CoefficientOptions options = heightOptions(inputs);
  options.enough = target.mean_square * of->counted();
  return followedByCorrections(codeHeights(of, target, options), relative_step,
                               inputs.options.threads);
}

}  // namespace tetrakis::inline heights
