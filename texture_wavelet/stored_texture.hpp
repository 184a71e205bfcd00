// SPDX-License-Identifier: Apache-2.0
// Textures that are stored sample by sample, because coding them would take more bytes.
#pragma once

#include <cstdint>
#include <span>

#include "base/texels.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis {

/// codeword: any prefix of the track of a texture with header.stored. Safe on any bytes. Samples of
/// which nothing is there are half of the largest. level: as for decodeTexture().
Texels decodeStoredTexture(const TextureHeader& header, std::span<const uint8_t> codeword,
                           int level);

}  // namespace tetrakis
