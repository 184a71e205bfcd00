// SPDX-License-Identifier: Apache-2.0
// Image to the track of a drawn texture.
#pragma once

#include <optional>

#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis {

/// Lossless, whole. Nothing if there are more than kMostColours colours, or if fewer than half of
/// the texels are like the one before or above them: that is no drawing.
std::optional<EncodedTexture> encodeDrawn(const Texels& texels);

}  // namespace tetrakis
