// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/restored_heights.hpp"

#include <cassert>
#include <memory>
#include <utility>
#include <vector>

#include "codec/geometry/height_layers.hpp"
#include "codec/geometry/steps/height_samples.hpp"

namespace tetrakis::inline heights {

namespace {

/// The track with the corrections behind all else.
EncodedTrack withCorrections(EncodedTrack track, const QuantisedHeights& of) {
  track.codeword.insert(track.codeword.end(), of.corrections.begin(), of.corrections.end());
  for (RatePoint& point : track.points) point.distortion += of.left;
  track.points.push_back({track.codeword.size(), 0});
  return track;
}

}  // namespace

HeightSteps shownSteps(const CodedHeights& heights, uint32_t threads) {
  DecodedHeights decoded = decodeHeights(heights.header, heights.layers,
                                         codewordsOf(heights.tracks), {}, {threads, nullptr});
  HeightSteps shown;
  shown.steps = wholeSteps(std::move(decoded.geometry));
  shown.valid = heights.of->steps.valid;
  shown.base = heights.of->steps.base;
  shown.step = heights.of->steps.step;
  return shown;
}

bool canBeRestored(const CodedHeights& lossy) {
  const QuantisedHeights& of = *lossy.of;
  return !of.steps.exact && !of.restored() && of.steps.table.empty() && !lossy.header.direct() &&
         lossy.closing == 0 && lossy.tracks.size() == 1 && lossy.tracks.front().complete;
}

CodedHeights codeRestored(const EncodeInputs& inputs, const CodedHeights& lossy) {
  assert(canBeRestored(lossy));
  const HeightSteps shown = shownSteps(lossy, inputs.options.threads);
  const auto of = std::make_shared<const QuantisedHeights>(
      withCorrections(*lossy.of, correctionsBehind(*lossy.of, shown)));
  const EncodedTrack& track = lossy.tracks.front();
  GeometryLayers layers = lossy.layers;
  layers.corrections = CorrectionKind::kSamples;
  layers.coefficient_bytes = track.codeword.size() - layers.openingBytes();
  return {.of = of,
          .header = lossy.header,
          .layers = std::move(layers),
          .tracks = {withCorrections(track, *of)},
          .closing = of->corrections.size(),
          .left = of->left,
          .flat = lossy.flat};
}

}  // namespace tetrakis::inline heights
