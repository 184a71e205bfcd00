// SPDX-License-Identifier: Apache-2.0
#include "encoder/targets/candidates.hpp"

#include <cassert>
#include <cmath>
#include <type_traits>
#include <utility>

#include "codec/geometry/stored_heights_encoder.hpp"
#include "encoder/heights/direct_heights.hpp"
#include "encoder/heights/height_errors.hpp"
#include "encoder/heights/height_options.hpp"
#include "encoder/heights/heights_notes.hpp"
#include "encoder/targets/component_curves.hpp"
#include "encoder/textures/texture_notes.hpp"
#include "encoder/views/pairs.hpp"
#include "ratecontrol/allocation/allocation.hpp"
#include "ratecontrol/allocation/packet_slopes.hpp"
#include "texture_wavelet/stored_texture_encoder.hpp"

namespace tetrakis::inline targets {

namespace {

template <class Coded>
uint8_t statedAfter(const EncodeInputs& inputs, const Candidate<Coded>& candidate, uint64_t bytes) {
  assert(candidate.curve);
  const Coded& coded = *candidate.coded;
  const Codewords prefix = prefixAfter(coded.accounted(), candidate.curve->packets, bytes);
  const double squares = squaresOf(coded, prefix, inputs.options.threads);
  const bool heights = std::is_same_v<Coded, CodedHeights>;
  const double weight = heights ? inputs.heaviest() : inputs.heaviestTexel();
  return qualityOf(std::sqrt(squares * weight / coded.counted()));
}

template <class Coded>
const ComponentCurve* curveIn(const Candidate<Coded>& candidate) {
  return candidate.curve ? &*candidate.curve : nullptr;
}

}  // namespace

Candidates withCurves(const EncodeInputs& inputs, Candidates candidates) {
  auto& [heights, texture, errors] = candidates;
  if (heights.coded && !heights.curve) heights.curve = curveOfHeights(inputs, *heights.coded);
  if (texture.coded && !texture.curve) texture.curve = curveOfTexture(inputs, *texture.coded);
  if (heights.coded && texture.coded && !errors)
    errors = std::make_shared<const PairErrors>(
        pairErrorsOf(inputs, {*heights.coded, *heights.curve}, {*texture.coded, *texture.curve}));
  return candidates;
}

Selection orderPackets(const Candidates& candidates) {
  const auto& [heights, texture, errors] = candidates;
  assert(!heights.coded == !heights.curve && !texture.coded == !texture.curve);
  Selection selection = {heights.coded, texture.coded, {}};
  selection.packets = errors ? allocate({*heights.curve, *texture.curve}, *errors)
                             : (heights.coded ? heights.curve : texture.curve)->packets;
  stateSlopes(selection.packets, {curveIn(heights), curveIn(texture)}, errors.get());
  return selection;
}

uint8_t qualityAfter(const EncodeInputs& inputs, const HeightsCandidate& heights, uint64_t bytes) {
  return statedAfter(inputs, heights, bytes);
}

uint8_t qualityAfter(const EncodeInputs& inputs, const TextureCandidate& texture, uint64_t bytes) {
  return statedAfter(inputs, texture, bytes);
}

bool hasLosslessWay(const CodedHeights& heights) {
  return heights.quantised->steps.exact;
}

/// Drawn and stored textures are lossless as they stand; tables of values are another way.
bool hasLosslessWay(const CodedTexture& texture) {
  return !texture.header.direct() || gapOfValues(texture) > 1;
}

HeightsCandidate codeLossless(const EncodeInputs& inputs, const CodedHeights& heights) {
  assert(hasLosslessWay(heights));
  return candidateOf(codeHeights(heights.quantised, Purpose::kLossless, heightOptions(inputs)));
}

TextureCandidate codeLossless(const EncodeInputs& inputs, const CodedTexture& texture) {
  assert(hasLosslessWay(texture));
  return candidateOf(codeTexture(inputs, texture.source, Purpose::kLossless));
}

HeightsCandidate storedIfShorter(const EncodeInputs& inputs, HeightsCandidate heights) {
  assert(!inputs.budgeted());
  const CodedHeights& coded = *heights.coded;
  const uint64_t samples = storedBytes(*inputs.heights, coded.quantised->steps.validCount());
  if (samples == 0) return heights;
  const uint64_t stored = samples + coded.quantised->layers.validity_bytes;
  if (stored >= heights.bytes()) {
    noteExpected(inputs, planOf(*coded.quantised, Coding::kStored), static_cast<double>(stored));
    return heights;
  }
  note(inputs, coded, Verdict::kLonger, heights.need);
  return candidateOf(storeHeights(coded.quantised, inputs.options.threads));
}

TextureCandidate storedIfShorter(const EncodeInputs& inputs, TextureCandidate texture) {
  const CodedTexture& coded = *texture.coded;
  const uint64_t stored = storedBytes(coded.source->texels);
  if (stored >= texture.bytes()) {
    if (!coded.header.stored) noteStoredExpected(inputs, stored);
    return texture;
  }
  note(inputs, coded, Verdict::kLonger, texture.need);
  return candidateOf(storeTexture(coded.source));
}

}  // namespace tetrakis::inline targets
