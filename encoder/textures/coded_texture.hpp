// SPDX-License-Identifier: Apache-2.0
// CodedTexture is a texture as a component of a stream: its tracks, and the header that describes
// them. The functions here make such values in each way to code a texture, and measure the texels
// that a decoder makes of a prefix. A value is not changed once it is made.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "ratecontrol/curves/coded_tracks.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "texture_wavelet/texture_source.hpp"

namespace tetrakis::inline textures {

struct CodedTexture {
  std::shared_ptr<const TextureSource> source;
  TextureHeader header;
  std::vector<EncodedTrack> tracks;  ///< distortion: squared error over the samples that count

  /// Bytes of the header that only some ways to code a texture need.
  uint64_t inHeader() const { return header.tables.code.size(); }
  /// The texels whose colours count in the error.
  Mask seen() const;
  /// Samples that count in the error.
  double counted() const;
  /// Behind the opening there is one codeword, of coefficients.
  bool holdsCoefficientsAlone() const { return tracks.size() == 1 && !header.direct(); }
  CodedTracks accounted() const {
    return {Component::kTexture, tracks, header.alpha_bytes + header.overlay_bytes};
  }
};

std::shared_ptr<const TextureSource> quantiseTexture(const tks_image& image);

/// Codes the texture by the coder that suits it. source: quantiseTexture() of the inputs' image.
CodedTexture codeTexture(const EncodeInputs& inputs, std::shared_ptr<const TextureSource> source,
                         Purpose purpose);

/// Codes the texture as the target of the options asks for it. source: as above.
CodedTexture codeTextureForTarget(const EncodeInputs& inputs,
                                  std::shared_ptr<const TextureSource> source);

/// Codes the same texture to the last bit, with the colours and filters of `lossy`, which is
/// neither drawn nor stored.
CodedTexture codeReversibly(const EncodeInputs& inputs, const CodedTexture& lossy);

/// How far apart values of the texture are that tables would hold; 1 if tables would not pay.
double gapOfValues(const CodedTexture& texture);

/// Stores the samples without coding them.
CodedTexture storeTexture(std::shared_ptr<const TextureSource> source);

/// Sum of squared errors of the samples that count. prefix: of the codeword of each track. memory:
/// that of calls for fewer bytes of a component with one track.
double squaresOf(const CodedTexture& texture, const Codewords& prefix, uint32_t threads,
                 TextureMemory* memory = nullptr);

/// The memory for the first call of squaresOf().
TextureMemory memoryFor(const CodedTexture& texture);

/// Whether the prefix reaches the PSNR of the options.
bool reachesPsnr(const EncodeInputs& inputs, const CodedTexture& texture, const Codewords& prefix);

}  // namespace tetrakis::inline textures
