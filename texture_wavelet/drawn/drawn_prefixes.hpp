// SPDX-License-Identifier: Apache-2.0
// prefixesOfDrawing() and prefixesOfOverlay() decode a drawn texture or an overlay once and give
// the texels of any prefix of it, because encoders look at many prefixes.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "base/texels.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"

namespace tetrakis::inline drawn {

/// Returns what gives the same as decodeDrawn() of the first bytes of the codeword at level 0, in
/// less time. codeword: all of it, as an encoder wrote it.
std::function<Texels(uint64_t bytes)> prefixesOfDrawing(const TextureHeader& header,
                                                        std::span<const uint8_t> codeword);

/// The same for decodeOverlay().
std::function<DrawnOverlay(uint64_t bytes)> prefixesOfOverlay(const TextureHeader& header,
                                                              std::span<const uint8_t> codeword);

}  // namespace tetrakis::inline drawn
