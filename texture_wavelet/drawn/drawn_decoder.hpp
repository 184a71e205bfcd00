// SPDX-License-Identifier: Apache-2.0
// Decodes the track of a drawn texture to an image. Integer arithmetic only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/texels.hpp"
#include "base/view.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "texture_wavelet/drawn/drawn_colours.hpp"

namespace tetrakis::inline drawn {

/// Decodes the texels at multiples of 2^level alone. codeword: any prefix of the track of a texture
/// with header.drawn(). Safe on any bytes.
Texels decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword, int level);

/// What lies over a photograph.
struct DrawnOverlay {
  std::vector<DrawnIndex> indices;  ///< of every texel; kSeeThrough where nothing is known
  DrawnColours colours;
};

/// The format of a texture, without samples.
Texels formatOf(const TextureHeader& header);

/// The colours of an overlay before any is coded.
DrawnColours overlayColours(const Texels& format);

/// codeword: any prefix of that of a texture's overlay. Safe on any bytes.
DrawnOverlay decodeOverlay(const TextureHeader& header, std::span<const uint8_t> codeword);

}  // namespace tetrakis::inline drawn
