// SPDX-License-Identifier: Apache-2.0
// Texture track to image. Integer only.
#pragma once

#include <cstdint>
#include <memory>

#include "base/texels.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"
#include "texture_wavelet/texture_opening.hpp"
#include "wavelet/region_decoder.hpp"
#include "wavelet/window.hpp"

namespace tetrakis {

/// What one call of decodeTexture() leaves to the next, whose only track is longer by some bytes
/// and starts in the same memory. Empty at first.
struct TextureMemory {
  std::shared_ptr<const TextureOpening> opening;  ///< once it is whole
  TrackMemory track;
};

/// codewords: any prefix of each track, one for each of regionsOf(). level: every 2^level-th texel
/// in x and y, up to the coarsest (wavelet/mip_level.hpp). Safe on any bytes and any header that
/// readHeader accepts. memory: of the calls before, with the same header and level.
Texels decodeTexture(const TextureHeader& header, const Codewords& codewords, int level = 0,
                     uint32_t threads = 1, TextureMemory* memory = nullptr);

/// The texels of a window, in time that follows its size where there are regions.
Texels decodeTextureWindow(const TextureHeader& header, const Codewords& codewords,
                           const Window& window, uint32_t threads = 1);

}  // namespace tetrakis
