// SPDX-License-Identifier: Apache-2.0
// Codes an image as texture tracks with the coder that suits it.
#pragma once

#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis {

/// By wavelet; or drawn, or stored, in one track where that is better. options: as for
/// encodeByWavelet(). Complete tracks without fraction bits that hide nothing are lossless.
EncodedTexture encodeTexture(const Texels& texels, Purpose purpose, TrackOptions options);

}  // namespace tetrakis
