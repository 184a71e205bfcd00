// SPDX-License-Identifier: Apache-2.0
// decodeTexture() decodes prefixes of the tracks of a texture to the texels of a view. It computes
// with integers only.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/texels.hpp"
#include "base/view.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "codec/wavelet/region_decoder.hpp"
#include "codec/wavelet/synthesis/plane_synthesis.hpp"
#include "texture_wavelet/texture_opening.hpp"

namespace tetrakis::inline texture {

/// What one call of decodeTexture() leaves to the next, whose tracks begin with the same bytes. It
/// is empty before the first call.
struct TextureMemory {
  OpeningMemory opening;
  TrackMemory tracks;  ///< once the opening is whole: what exists of them follows from it
  /// Of encoders, which have all of a drawing: what its first bytes show.
  std::function<Texels(uint64_t bytes)> drawing = {};
  /// Of encoders that look at many prefixes of small textures: the colour planes, most of which a
  /// few more bytes leave as they are; empty: they are not kept.
  std::vector<SynthesisMemory> planes = {};

  uint64_t bytes() const;
};

/// Decodes what a view shows; in a window the time follows its size if the image has regions.
/// codewords: any prefix of each track, one for each of regionsOf(). Safe on any bytes and on any
/// header that readHeader() accepts. The memory is that of earlier calls with the same header, for
/// views of which it keeps all levels, or with the same view.
Texels decodeTexture(const TextureHeader& header, const Codewords& codewords, const View& view = {},
                     const DecodeContext<TextureMemory>& context = {});

}  // namespace tetrakis::inline texture
