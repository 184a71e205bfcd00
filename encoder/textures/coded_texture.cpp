// SPDX-License-Identifier: Apache-2.0
#include "encoder/textures/coded_texture.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/samples.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "ratecontrol/curves/component_curve.hpp"
#include "texture_wavelet/drawn/drawn_encoder.hpp"
#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis::inline textures {

namespace {

/// The largest number of texels in one region. A larger number saves more textures the bytes that
/// regions cost; their windows then take the whole texture.
constexpr uint64_t kOneRegionTexels = 2048 * 2048;

}  // namespace

TextureOptions textureOptions(const EncodeInputs& inputs, const Texels& texels) {
  const tks_encode_options& options = inputs.options;
  const Extent extent = texels.extent();
  const RegionChoice regions =
      chooseRegions(options, extent, extent.samples() > kOneRegionTexels, patchesOf(*inputs.image));
  const Priorities* const priorities = inputs.priorities;
  const bool some_first = priorities != nullptr && !priorities->texture.empty();
  const bool to_psnr = options.psnr > 0;
  const double heaviest = inputs.heaviestTexel();
  return {.limit = limitOf(inputs),
          .region_log2 = regions.side_log2,
          .threads = options.threads,
          .windows = regions.windows,
          .visual = options.weights == TKS_WEIGHTS_VISUAL,
          .room = inputs.budgeted() ? options.bytes : UINT64_MAX,
          .mean_square = to_psnr ? worstMeanSquare(texels.white(), options.psnr) / heaviest : 0,
          .priorities = some_first ? &priorities->texture : nullptr};
}

CodedLines texelLines(const EncodeInputs& inputs) {
  if (inputs.image == nullptr || inputs.image->domain == TKS_DOMAIN_FOREST) return {};
  const tks_image& image = *inputs.image;
  CodedLines lines = linesThatPay(
      inputs.options,
      {image.data, {image.width, image.height}, image.channels * tks_sample_bytes(image.sample)},
      1);
  if (lines.repeats.none() || inputs.options.psnr == 0) return lines;
  const bool alpha = image.channels % 2 == 0;
  return lines.heaviest <= (alpha ? 1 : CodedLines::kNearlyAlike) ? lines : CodedLines();
}

namespace {

CodedTexture codedBy(std::shared_ptr<const TextureSource> source, EncodedTexture encoded) {
  assert(!encoded.tracks.empty() && encoded.header.width == source->texels.width);
  encoded.header.wavelet.ring = source->ring;
  encoded.header.wavelet.forest = source->forest;
  return {std::move(source), std::move(encoded.header), std::move(encoded.tracks)};
}

/// Codes the texture by the coder that suits it, and notes what was passed over.
CodedTexture codeNoting(const EncodeInputs& inputs, std::shared_ptr<const TextureSource> source,
                        Purpose purpose, TextureOptions options) {
  PassedTextures passed;
  if (inputs.notes != nullptr) options.passed = &passed;
  EncodedTexture encoded = encodeTexture(*source, purpose, options);
  notePassed(inputs, *source, passed);
  return codedBy(std::move(source), std::move(encoded));
}

}  // namespace

std::shared_ptr<const TextureSource> quantiseTexture(const tks_image& image) {
  Texels texels{image.width, image.height,     image.channels, image.sample == TKS_U8 ? 8 : 16,
                {},          image.opaque != 0};
  if (image.white_level < texels.most())
    texels.white_level = static_cast<uint16_t>(image.white_level);
  const size_t count = size_t{image.width} * image.height * image.channels;
  withSampleType(image.sample, [&](auto type) {
    const auto* from = static_cast<const decltype(type)*>(image.data);
    texels.samples.resize(count);
    std::transform(from, from + count, texels.samples.begin(),
                   [](auto v) { return static_cast<uint16_t>(v); });
  });
  const bool ring = image.domain == TKS_DOMAIN_CYLINDER;
  return std::make_shared<const TextureSource>(std::move(texels), ring, forestOf(image));
}

Mask CodedTexture::seen() const {
  return source->counted(header.wavelet.fraction_bits > 0 ? Purpose::kLossy : Purpose::kLossless);
}

double CodedTexture::counted() const {
  return static_cast<double>(countedSamples(source->texels, seen()));
}

CodedTexture codeTexture(const EncodeInputs& inputs, std::shared_ptr<const TextureSource> source,
                         Purpose purpose) {
  const TextureOptions options = textureOptions(inputs, source->texels);
  return codeNoting(inputs, std::move(source), purpose, options);
}

CodedTexture codeReversibly(const EncodeInputs& inputs, const CodedTexture& lossy) {
  const TextureOptions options = textureOptions(inputs, lossy.source->texels);
  return codedBy(lossy.source, encodeReversibly(*lossy.source, lossy.header, options));
}

/// Coding for a PSNR ends by the account. If the samples then miss the PSNR, coding goes on.
CodedTexture codeTextureForTarget(const EncodeInputs& inputs,
                                  std::shared_ptr<const TextureSource> source) {
  CodedTexture coded = codeTexture(inputs, std::move(source), purposeOf(inputs));
  if (inputs.options.psnr <= 0 || coded.tracks.front().complete) return coded;
  if (reachesPsnr(inputs, coded, codewordsOf(coded.tracks))) return coded;
  TextureOptions to_the_end = textureOptions(inputs, coded.source->texels);
  to_the_end.mean_square = 0;
  return codeNoting(inputs, coded.source, purposeOf(inputs), to_the_end);
}

double gapOfValues(const CodedTexture& texture) {
  const FewValues few = fewValuesOf(*texture.source, {});
  const uint32_t colours = texture.source->colours();
  const double squares =
      std::accumulate(few.squares.begin(), few.squares.begin() + static_cast<int>(colours), 0.);
  return std::sqrt(squares / colours);
}

CodedTexture storeTexture(std::shared_ptr<const TextureSource> source) {
  EncodedTexture stored = encodeStoredTexture(source->texels);
  return codedBy(std::move(source), std::move(stored));
}

double squaresOf(const CodedTexture& texture, const Codewords& prefix, uint32_t threads,
                 TextureMemory* memory) {
  assert(prefix.size() == texture.tracks.size());
  const Texels shown = decodeTexture(texture.header, prefix, {}, {threads, memory});
  return countedSquares(texture.source->texels, shown, texture.seen());
}

TextureMemory memoryFor(const CodedTexture& texture) {
  const TextureHeader& header = texture.header;
  const std::span<const uint8_t> codeword = texture.tracks.front().codeword;
  TextureMemory memory;
  if (header.drawn()) memory.drawing = prefixesOfDrawing(header, codeword);
  if (texture.source->texels.samples.size() <= kSmallSamples)
    memory.planes.resize(header.colourPlanes());
  if (header.overlay_bytes > 0) {
    const auto overlay = codeword.subspan(header.alpha_bytes, header.overlay_bytes);
    memory.opening.overlay = prefixesOfOverlay(header, overlay);
  }
  return memory;
}

bool reachesPsnr(const EncodeInputs& inputs, const CodedTexture& texture, const Codewords& prefix) {
  const double squares = squaresOf(texture, prefix, inputs.options.threads);
  return squares / texture.counted() * inputs.heaviestTexel() <=
         worstMeanSquare(texture.source->texels.white(), inputs.options.psnr);
}

}  // namespace tetrakis::inline textures
