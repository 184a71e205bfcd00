// SPDX-License-Identifier: Apache-2.0
// Texture tracks to image. Integer only.
#pragma once

#include <cstdint>

#include "bitstream/header.hpp"
#include "bitstream/packet.hpp"
#include "texture_wavelet/texels.hpp"
#include "wavelet/window.hpp"

namespace tetrakis {

/// codewords: any prefix of each track, one for each of regionsOf(). Safe on any bytes and any
/// header that readHeader accepts.
Texels decodeTexture(const TextureHeader& header, const Codewords& codewords, uint32_t threads = 1);

/// The texels of a window, in time that follows its size where there are regions.
Texels decodeTextureWindow(const TextureHeader& header, const Codewords& codewords,
                           const Window& window, uint32_t threads = 1);

}  // namespace tetrakis
