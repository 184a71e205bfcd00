// SPDX-License-Identifier: Apache-2.0
// CodedTexture is a texture as the tracks and the header of a component. The functions of this file
// make it in each way to code a texture, measure the errors of its prefixes, and note how it was
// coded.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/samples.hpp"
#include "bitstream/stream/header.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/plans/plan.hpp"
#include "ratecontrol/curves/component_curve.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "texture_wavelet/texture_source.hpp"

namespace tetrakis::inline textures {

// CodedTexture is a texture as a component of a stream: its tracks, and the header that describes
// them. A value is not changed once it is made. codeTexture() and its siblings make it, and
// squaresOf() measures the texels that a decoder makes of a prefix.

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

/// The options for coding a texture. inputs: with an image, which is `texels`.
TextureOptions textureOptions(const EncodeInputs& inputs, const Texels& texels);

/// Codes the texture by the coder that suits it. source: quantiseTexture() of the inputs' image.
CodedTexture codeTexture(const EncodeInputs& inputs, std::shared_ptr<const TextureSource> source,
                         Purpose purpose);

/// Codes the texture as the target of the options asks for it. source: as codeTexture() takes it.
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

// texelLines() finds the columns and rows of the input image that repeat the one before them, so
// that only the other lines are coded (encoder/inputs/encode_inputs.hpp).

/// The lines of the image to code; none where all are. A PSNR counts all texels, so for a PSNR all
/// lines are coded if runs differ clearly in length, or beside an alpha, where nobody knows by how
/// much a run counts.
CodedLines texelLines(const EncodeInputs& inputs);

// planOf() reads the plan of a texture from its header. note(), notePassed() and the others
// tell the notes of an encoding, if somebody asked for them, of textures that were weighed.

/// header: with filters, if it is that of coded coefficients.
Plan planOf(const TextureHeader& header);

/// Notes a texture that was coded. need: bytes of its tracks that the target needs, at most.
void note(const EncodeInputs& inputs, const CodedTexture& coded, Verdict verdict,
          uint64_t need = UINT64_MAX);

/// Notes what encodeTexture() has passed over.
void notePassed(const EncodeInputs& inputs, const TextureSource& source,
                const PassedTextures& passed);

/// Notes that storing the samples is expected to take `bytes` bytes, which are too many.
void noteStoredExpected(const EncodeInputs& inputs, uint64_t bytes);

}  // namespace tetrakis::inline textures
