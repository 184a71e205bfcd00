// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/ways/restored_heights.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <utility>

#include "codec/geometry/heights_decoder.hpp"
#include "encoder/heights/followed_heights.hpp"

namespace tetrakis::inline ways {

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
         !lossy.header.direct() && !lossy.hasCorrections() &&
         std::all_of(lossy.tracks.begin(), lossy.tracks.end(),
                     [](const EncodedTrack& track) { return track.complete; });
}

CodedHeights codeRestored(const EncodeInputs& inputs, const CodedHeights& lossy) {
  assert(canBeRestored(lossy));
  const uint32_t threads = inputs.options.threads;
  const HeightSteps shown = shownSteps(lossy, threads);
  const auto quantised = std::make_shared<const QuantisedHeights>(withCorrections(
      *lossy.quantised,
      correctionsBehind(*lossy.quantised, shown, lossy.header.regions.side_log2, threads)));
  GeometryLayers layers = lossy.layers;
  layers.corrections = CorrectionKind::kSamples;
  CodedHeights heights = lossy;
  heights.quantised = quantised;
  return restoredBy(std::move(heights), std::move(layers), quantised->corrections, quantised->left);
}

}  // namespace tetrakis::inline ways
