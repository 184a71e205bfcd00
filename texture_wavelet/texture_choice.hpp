// SPDX-License-Identifier: Apache-2.0
// Codes an image by the coder that suits it: what is drawn as it is, photographs by wavelet, and
// what no coder helps sample by sample.
#pragma once

#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis {

/// By wavelet; or drawn, or stored, in one track where that is better. Complete tracks without
/// fraction bits that hide nothing are lossless.
EncodedTexture encodeTexture(const TextureSource& source, Purpose purpose, TextureOptions options);

}  // namespace tetrakis
