// SPDX-License-Identifier: Apache-2.0
// encodeDrawn() codes an image of few colours as the track of a drawn texture, and encodeOverlay()
// codes the overlay of a photograph.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/texels.hpp"
#include "bitstream/stream/encoded_texture.hpp"

namespace tetrakis::inline drawn {

/// Lossless, whole. Nothing if there are more than kMostDrawnValues colours; or if fewer than half
/// of the texels are like the one before or above them, unless so the drawing takes about `most`
/// bytes or fewer: else that is no drawing.
std::optional<EncodedTexture> encodeDrawn(const Texels& texels, uint64_t most = 0);

/// Returns the codeword of an overlay: which texels the photograph does not mark, and the colours
/// of those. There are fewer than kMostDrawnValues colours.
std::vector<uint8_t> encodeOverlay(const Texels& texels, Mask photograph);

}  // namespace tetrakis::inline drawn
