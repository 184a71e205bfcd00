// SPDX-License-Identifier: Apache-2.0
// Image to texture track, by the coder that suits it.
#pragma once

#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis {

/// By wavelet, or drawn where that is better. limit: as for encodeByWavelet(); half of it is what a
/// budget has room for. A complete track without fraction bits that hides nothing is lossless.
EncodedTexture encodeTexture(const Texels& texels, Purpose purpose, uint64_t limit);

}  // namespace tetrakis
