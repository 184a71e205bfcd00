// SPDX-License-Identifier: Apache-2.0
// The candidates of both components get their curves, their packets in order, and the bytes that a
// PSNR needs; lossless coding and stored samples make further candidates.
#include "encoder/targets/targets.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>
#include <utility>

#include "codec/geometry/heights_encoder.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/mesh/decimation/decimation.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/heights/quantised_heights.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "encoder/views/decoded_nodes.hpp"
#include "encoder/views/pairs.hpp"
#include "ratecontrol/allocation/allocation.hpp"
#include "ratecontrol/needs/needs.hpp"
#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis::inline targets {

namespace {

/// Tracks of more samples are decoded anew for each prefix. A larger number takes eight bytes of
/// memory for each sample, and saves some hundredths of the time of encoding.
constexpr size_t kRemembered = size_t{1} << 22;
/// Heights end where their squared error is this part of the error of a mesh of the triangle
/// budget. With 16 the RMSE of the mesh would fall by 3 % at most; a larger number takes bytes from
/// the texture.
constexpr double kMeshPart = 16;

/// Prefixes of a forest take longer: every line of a patch, and of those beside it, as long as so
/// many samples. A larger number saves time, and finds fewer dips.
constexpr size_t kLineSamples = 128;

/// The budget does not limit the audit of lossless coefficients, because they are sent whole or not
/// at all. Lossy ones of as many bits have no fraction bits either.
AuditScope auditScope(const EncodeInputs& inputs, size_t samples, const WaveletHeader& wavelet) {
  const bool lossless =
      wavelet.fraction_bits == 0 && wavelet.bits > 0 && wavelet.bits < kBitsWithFractions;
  const size_t lines = wavelet.forest != nullptr ? samples / wavelet.forest->side() : 0;
  return {samples + kLineSamples * lines,
          inputs.budgeted() && !lossless ? inputs.options.bytes : UINT64_MAX,
          inputs.options.max_error > 0};
}

/// Whether the states of the tracks are decoded anew for each prefix, because the samples are many:
/// remembering all states takes eight bytes a sample beside the memory of encoding, and saves some
/// hundredths of its time.
bool areTooLarge(const std::vector<EncodedTrack>& tracks, size_t samples) {
  return tracks.size() > 1 && samples > kRemembered;
}

/// The order of the tracks: a stream with a front index is fetched by ranges.
TrackOrder trackOrderOf(const tks_encode_options& options) {
  if (options.index == TKS_INDEX_WINDOWS) return TrackOrder::kTracks;
  return options.index != TKS_INDEX_NONE ? TrackOrder::kClasses : TrackOrder::kSlopes;
}

/// The mean squared error of the heights (in steps) below which more bytes no longer help, with a
/// triangle budget whose meshes cameras do not look at (encoder/views/decoded_nodes.hpp). A mesh of
/// that many triangles is itself off by kMeshPart times as much. 0 without a triangle budget.
double meshFloor(const QuantisedHeights& heights, uint32_t triangles) {
  if (triangles == 0) return 0;
  const Result<MeshSequence> sequence =
      decimate({heights.samples->width, heights.samples->height, heights.steps.steps});
  if (!sequence.ok()) return 0;
  const double squares = sequence->squaredError(sequence->bestPrefix(triangles));
  assert(squares >= 0);
  return squares / heights.counted() / kMeshPart;
}

}  // namespace

ComponentCurve curveOfHeights(const EncodeInputs& inputs, const CodedHeights& heights) {
  const QuantisedHeights& source = *heights.quantised;
  const bool modelled = looksAtMeshes(inputs, source);
  const Pricing pricing{.samples = heights.counted() / inputs.heaviest(),
                        .floor = modelled ? 0 : meshFloor(source, inputs.options.triangles),
                        .shared = inputs.image != nullptr,
                        .order = trackOrderOf(inputs.options)};
  HeightsMemory memory = memoryFor(heights);
  memory.tracks.forgets = areTooLarge(heights.tracks, source.steps.steps.size());
  const auto measure = [&](const std::vector<Packet>& packets, uint64_t bytes) {
    return squaresOf(heights, prefixAfter(heights.accounted(), packets, bytes),
                     inputs.options.threads, &memory);
  };
  return curveOf(heights.accounted(),
                 auditScope(inputs, source.steps.steps.size(), heights.header.wavelet), measure,
                 pricing);
}

ComponentCurve curveOfTexture(const EncodeInputs& inputs, const CodedTexture& texture) {
  TextureMemory memory = memoryFor(texture);
  memory.tracks.forgets = areTooLarge(texture.tracks, texture.source->texels.samples.size());
  const auto measure = [&](const std::vector<Packet>& packets, uint64_t bytes) {
    return squaresOf(texture, prefixAfter(texture.accounted(), packets, bytes),
                     inputs.options.threads, &memory);
  };
  return curveOf(texture.accounted(),
                 auditScope(inputs, texture.source->texels.samples.size(), texture.header.wavelet),
                 measure,
                 {.samples = texture.counted(),
                  .shared = inputs.heights != nullptr,
                  .order = trackOrderOf(inputs.options)});
}

std::optional<uint64_t> heightsNeed(const EncodeInputs& inputs, const HeightsCandidate& heights) {
  const CodedHeights& coded = *heights.coded;
  const SampleRange range = rangeOf(*inputs.heights, coded.quantised->steps.valid);
  const double worst = worstMeanSquare(range.high - range.low, inputs.options.psnr);
  const auto& packets = heights.curve->packets;
  // The last bytes of a mask may change nothing, and then there are none of them.
  const Codewords all = prefixAfter(coded.accounted(), packets, payloadOf(packets));
  const uint64_t masked = std::min<uint64_t>(coded.layers.maskEnd(), all.front().size());
  return leastBytes(packets, [&](uint64_t bytes) {
    const Codewords prefix = prefixAfter(coded.accounted(), packets, bytes);
    if (prefix.front().size() < masked) return false;
    const SampleErrors errors = sampleErrorsOf(coded, prefix, inputs.options.threads);
    return errors.mean_square * inputs.heaviest() <= worst;
  });
}

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
