// SPDX-License-Identifier: Apache-2.0
// Texture track to image. Integer only.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/header.hpp"
#include "texture_wavelet/texels.hpp"

namespace tetrakis {

/// codeword: any prefix of a texture track. level: every 2^level-th texel in x and y, up to the
/// coarsest (wavelet/mip_level.hpp). Safe on any bytes and any header that readHeader accepts.
Texels decodeTexture(const TextureHeader& header, std::span<const uint8_t> codeword, int level = 0);

}  // namespace tetrakis
