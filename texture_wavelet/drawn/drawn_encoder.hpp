// SPDX-License-Identifier: Apache-2.0
// Image to the track of a drawn texture.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/texels.hpp"
#include "bitstream/stream/encoded_texture.hpp"

namespace tetrakis {

/// Lossless, whole. Nothing if there are more than kMostColours colours, or if fewer than half of
/// the texels are like the one before or above them: that is no drawing.
std::optional<EncodedTexture> encodeDrawn(const Texels& texels);

/// The codeword of an overlay: the colours of the texels that are 0 in `coded`, and which those
/// are. They have fewer than kMostColours.
std::vector<uint8_t> encodeOverlay(const Texels& texels, std::span<const uint8_t> coded);

}  // namespace tetrakis
