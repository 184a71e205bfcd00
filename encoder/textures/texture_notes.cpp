// SPDX-License-Identifier: Apache-2.0
#include "encoder/textures/coded_texture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tetrakis::inline textures {

namespace {

CodedOutcome outcomeOf(uint64_t bytes, const TextureHeader& header, double squares,
                       double counted) {
  return {bytes, bytes, header.tables.code.size(), std::sqrt(squares / counted)};
}

Verdict verdictOf(PassedFor reason) {
  switch (reason) {
    case PassedFor::kExpectedLonger:
      return Verdict::kExpectedLonger;
    case PassedFor::kLonger:
      return Verdict::kLonger;
    case PassedFor::kShowsWorse:
      return Verdict::kWorsePrefixes;
  }
  return Verdict::kLonger;
}

/// The samples whose errors the account of a texture with this header counts.
double countedOf(const TextureSource& source, const TextureHeader& header) {
  const bool lossy = header.wavelet.fraction_bits > 0;
  const Mask seen = source.counted(lossy ? Purpose::kLossy : Purpose::kLossless);
  return static_cast<double>(countedSamples(source.texels, seen));
}

}  // namespace

Plan planOf(const TextureHeader& header) {
  const auto& values = header.tables.values;
  Plan plan{.base = header.coding(),
            .table_values = std::accumulate(values.begin(), values.end(), uint32_t{0})};
  if (header.bridge > 0) plan.layers.push_back(Layer::kBridges);
  if (header.alpha_bytes > 0) plan.layers.push_back(Layer::kCutOut);
  if (header.overlay_bytes > 0) plan.layers.push_back(Layer::kOverlay);
  if (header.direct()) return plan;
  plan.filters = header.wavelet.filters;
  plan.fractions = header.wavelet.fraction_bits > 0;
  if (!header.priorities.none()) plan.layers.push_back(Layer::kPriorities);
  if (header.regions.side_log2 > 0) plan.layers.push_back(Layer::kRegions);
  return plan;
}

void note(const EncodeInputs& inputs, const CodedTexture& coded, Verdict verdict, uint64_t need) {
  if (inputs.notes == nullptr) return;
  double squares = 0;
  for (const EncodedTrack& track : coded.tracks) squares += track.points.back().distortion;
  CodedOutcome outcome = outcomeOf(bytesOf(coded.tracks), coded.header, squares, coded.counted());
  outcome.needed = std::min(need, outcome.bytes);
  inputs.notes->texture.add({planOf(coded.header), verdict, {}, outcome});
}

void notePassed(const EncodeInputs& inputs, const TextureSource& source,
                const PassedTextures& passed) {
  if (inputs.notes == nullptr) return;
  for (const PassedTexture& one : passed) {
    WeighedPlan weighed{planOf(one.header), verdictOf(one.reason)};
    if (one.reason == PassedFor::kExpectedLonger) {
      weighed.expected = static_cast<double>(one.bytes);
      weighed.plan.filters.reset();
    } else {
      weighed.coded = outcomeOf(one.bytes, one.header, one.squares, countedOf(source, one.header));
    }
    inputs.notes->texture.add(std::move(weighed));
  }
}

void noteStoredExpected(const EncodeInputs& inputs, uint64_t bytes) {
  if (inputs.notes == nullptr) return;
  inputs.notes->texture.add(
      {{.base = Coding::kStored}, Verdict::kExpectedLonger, static_cast<double>(bytes)});
}

}  // namespace tetrakis::inline textures
