// SPDX-License-Identifier: Apache-2.0
// decodeDrawn() and decodeOverlay() decode any prefix of the codeword of a drawn texture, or of an
// overlay, to texels. They compute with integers only.
#pragma once

#include <cstdint>
#include <span>

#include "base/texels.hpp"
#include "base/view.hpp"
#include "base/zeroed_array.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "texture_wavelet/drawn/drawn_colours.hpp"

namespace tetrakis::inline drawn {

/// Decodes what a view shows. Of a level only its texels are decoded; for a window all are, but
/// only those that it needs get colours. codeword: any prefix of the track of a texture with
/// header.drawn(). Safe on any bytes.
Texels decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword,
                   const View& view);

/// What lies over a photograph.
struct DrawnOverlay {
  ZeroedArray<KeptIndex> indices;  ///< of every texel
  uint32_t step = 1;               ///< those that are known lie at its multiples
  DrawnColours colours;

  /// Where nothing is known nothing is shown.
  bool covers(size_t texel) const {
    const DrawnIndex index = indices[texel];
    return index != kNoIndex && index != kSeeThrough;
  }
};

/// The format of a texture, without samples.
Texels formatOf(const TextureHeader& header);

/// The colours of an overlay before any is coded.
DrawnColours overlayColours(const Texels& format);

/// codeword: any prefix of that of a texture's overlay. Safe on any bytes.
DrawnOverlay decodeOverlay(const TextureHeader& header, std::span<const uint8_t> codeword);

}  // namespace tetrakis::inline drawn
