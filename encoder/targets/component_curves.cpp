// SPDX-License-Identifier: Apache-2.0
#include "encoder/targets/component_curves.hpp"

#include <cassert>

#include "codec/mesh/decimation/decimation.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "encoder/heights/height_errors.hpp"
#include "encoder/views/shown_mesh.hpp"

namespace tetrakis::inline targets {

namespace {

/// Tracks of more samples are decoded anew for each prefix. A larger number takes eight bytes of
/// memory for each sample, and saves some hundredths of the time of encoding.
constexpr size_t kRemembered = size_t{1} << 22;
/// Heights end where their squared error is this part of the error of a mesh of the triangle
/// budget. With 16 the RMSE of the mesh would fall by 3 % at most; a larger number takes bytes from
/// the texture.
constexpr double kMeshPart = 16;

/// The budget does not limit the audit of lossless coefficients, because they are sent whole or not
/// at all. Lossy ones of as many bits have no fraction bits either.
AuditScope auditScope(const EncodeInputs& inputs, size_t samples, const WaveletHeader& wavelet) {
  const bool lossless =
      wavelet.fraction_bits == 0 && wavelet.bits > 0 && wavelet.bits < kBitsWithFractions;
  return {samples, inputs.budgeted() && !lossless ? inputs.options.bytes : UINT64_MAX,
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
/// triangle budget whose meshes cameras do not look at (encoder/views/shown_mesh.hpp). A mesh of
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

}  // namespace tetrakis::inline targets
