// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/ways/restored_heights.hpp"

#include <cassert>
#include <memory>
#include <utility>

#include "codec/geometry/height_layers.hpp"

namespace tetrakis::inline ways {

namespace {

/// The track with the corrections behind all else.
EncodedTrack withCorrections(EncodedTrack track, const QuantisedHeights& quantised) {
  track.codeword.insert(track.codeword.end(), quantised.corrections.begin(),
                        quantised.corrections.end());
  for (RatePoint& point : track.points) point.distortion += quantised.left;
  track.points.push_back({track.codeword.size(), 0});
  return track;
}

}  // namespace

HeightSteps shownSteps(const CodedHeights& heights, uint32_t threads) {
  DecodedHeights decoded = decodeHeights(heights.header, heights.layers,
                                         codewordsOf(heights.tracks), {}, {threads, nullptr});
  HeightSteps shown;
  shown.steps = wholeSteps(std::move(decoded.geometry));
  shown.valid = heights.quantised->steps.valid;
  shown.base = heights.quantised->steps.base;
  shown.step = heights.quantised->steps.step;
  return shown;
}

bool canBeRestored(const CodedHeights& lossy) {
  const QuantisedHeights& quantised = *lossy.quantised;
  return !quantised.steps.exact && !quantised.restored() && quantised.steps.table.empty() &&
         !lossy.header.direct() && lossy.closing == 0 && lossy.tracks.size() == 1 &&
         lossy.tracks.front().complete;
}

CodedHeights codeRestored(const EncodeInputs& inputs, const CodedHeights& lossy) {
  assert(canBeRestored(lossy));
  const HeightSteps shown = shownSteps(lossy, inputs.options.threads);
  const auto quantised = std::make_shared<const QuantisedHeights>(
      withCorrections(*lossy.quantised, correctionsBehind(*lossy.quantised, shown)));
  const EncodedTrack& track = lossy.tracks.front();
  GeometryLayers layers = lossy.layers;
  layers.corrections = CorrectionKind::kSamples;
  layers.coefficient_bytes = track.codeword.size() - layers.besideCoefficients();
  return {.quantised = quantised,
          .header = lossy.header,
          .layers = std::move(layers),
          .tracks = {withCorrections(track, *quantised)},
          .closing = quantised->corrections.size(),
          .left = quantised->left,
          .shown_void = lossy.shown_void,
          .flat = lossy.flat};
}

}  // namespace tetrakis::inline ways
