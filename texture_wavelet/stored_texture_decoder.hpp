// SPDX-License-Identifier: Apache-2.0
// decodeStoredTexture() reads the texels of a view from a texture whose samples are stored, because
// coding them would take more bytes.
#pragma once

#include <cstdint>
#include <span>

#include "base/texels.hpp"
#include "base/view.hpp"
#include "bitstream/stream/texture_header.hpp"

namespace tetrakis::inline texture {

/// Returns the texels that a view shows. codeword: any prefix of the track of a texture with
/// header.stored. Safe on any bytes. A sample that has no byte yet is half of the largest.
Texels decodeStoredTexture(const TextureHeader& header, std::span<const uint8_t> codeword,
                           const View& view);

}  // namespace tetrakis::inline texture
