// SPDX-License-Identifier: Apache-2.0
// Texture track to image. Integer only.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/header.hpp"
#include "texture_wavelet/texels.hpp"

namespace tetrakis {

/// codeword: any prefix of a texture track. Safe on any bytes and any header that readHeader
/// accepts.
Texels decodeTexture(const TextureHeader& header, std::span<const uint8_t> codeword);

}  // namespace tetrakis
