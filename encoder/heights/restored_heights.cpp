// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/restored_heights.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <utility>
#include <vector>

#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/geometry/height_layers.hpp"
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

}  // namespace

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
