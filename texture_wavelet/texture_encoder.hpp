// SPDX-License-Identifier: Apache-2.0
// encodeTexture() takes an image and returns the tracks of a texture, by the coder that takes the
// fewest bytes for its purpose: the wavelet, a drawing, or its samples as they are. Encoder only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/samples.hpp"
#include "bitstream/stream/encoded_texture.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/tables/channel_tables_encoder.hpp"
#include "texture_wavelet/texture_source.hpp"

namespace tetrakis::inline texture {

// encodeStoredTexture() writes the samples of an image without coding them, where no coder takes
// fewer bytes.

/// Bytes that storing takes.
uint64_t storedBytes(const Texels& texels);

/// One track, lossless.
EncodedTexture encodeStoredTexture(const Texels& texels);

// encodeTextureFrames() codes images that follow one another in time, as the frames of one texture.

/// The texture of the group before, as so many bytes of its stream show its last frame.
struct TextureBefore {
  uint64_t bytes = 0;
  const TextureHeader* header = nullptr;
  std::shared_ptr<const FrameReference> last;
};

/// frames: 1 to 32 images of one size and kind. ring: WaveletHeader::ring. before: what they may go
/// on from, if that takes fewer bits; nothing: they stand by themselves. Complete tracks for
/// Purpose::kLossless are lossless. Distortion is the squared error of all samples, alpha included.
EncodedTexture encodeTextureFrames(const std::vector<Texels>& frames, bool ring, Purpose purpose,
                                   const TextureOptions& options,
                                   const std::optional<TextureBefore>& before = {});

// energiesOf() and the functions below it are what all textures that are coded by wavelet share.

/// What the squared error of each channel counts.
using ChannelWeights = std::array<double, 4>;

/// Squared error of all channels per squared error of each colour plane's coefficients of a level;
/// alpha counts like a colour.
std::vector<double> energiesOf(size_t planes, const ColourTransform& colour, int level,
                               const ChannelWeights& weights);

/// Those colour planes come first whose errors count most.
std::array<int64_t, 4> prioritiesOf(size_t planes, const ColourTransform& colour,
                                    const ChannelWeights& weights);

/// Where coding ends for an error that is to be reached. samples: that count.
TrackOptions untilReached(const TextureOptions& options, uint64_t samples);

/// Writes the transform into a header.
void describeColour(const ColourTransform& colour, TextureHeader& header);

// visualWeights() gives each band of each colour plane a weight, so that passes come in the order
// in which an eye notices them.

/// planes: 1 to 4, the last of an even number being alpha or a further colour, which is weighted
/// like the first.
BandWeights visualWeights(uint32_t planes);

// encodeByWavelet() codes an image by wavelet. It fits a colour transform and filters to the image
// and codes the coefficients that they leave into tracks.

/// An alpha that has nothing but 0 and the largest value becomes a cut-out: a mask ahead of
/// everything in the first track. Colours that it hides are coded for Purpose::kLossless alone.
/// photograph: from photographOf(). It marks the texels of the photograph; the others are the
/// overlay, which comes next. If it marks every texel there is no overlay. Complete tracks without
/// fraction bits that hide nothing are lossless. like: a header whose colours, filters and choice
/// of tables are taken over; null: they are chosen, which gives those of an attempt of the same
/// purpose and photograph, and there are no tables.
EncodedTexture encodeByWavelet(const TextureSource& source, Purpose purpose,
                               const TextureOptions& options, Mask photograph = {},
                               const TextureHeader* like = nullptr);

/// The same for Purpose::kLossless, with tables of the values that channels have.
EncodedTexture encodeInTables(const TextureSource& source, const FewValues& few,
                              const TextureOptions& options, Mask photograph = {});

/// The tables that may save bytes where all colours of the photograph are coded.
FewValues fewValuesOf(const TextureSource& source, Mask photograph);

// encodeTexture() codes an image by the coder that suits it: drawings colour by colour, photographs
// by wavelet, and images that no coder makes smaller sample by sample.

/// Codes the image by wavelet; or it is drawn or stored, in one track, where that is better.
/// Complete tracks without fraction bits that hide nothing are lossless.
EncodedTexture encodeTexture(const TextureSource& source, Purpose purpose, TextureOptions options);

/// The image that was coded by wavelet with the header `lossy`, to the last bit, with its colours
/// and filters: so prefixes are nearly as good. That takes 4 % more bytes than colours and filters
/// that suit the last bit.
EncodedTexture encodeReversibly(const TextureSource& source, TextureHeader lossy,
                                const TextureOptions& options);

}  // namespace tetrakis::inline texture
