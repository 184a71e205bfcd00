// SPDX-License-Identifier: Apache-2.0
// Stores an image sample by sample in one track.
#pragma once

#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis {

/// Bytes that storing takes.
uint64_t storedBytes(const Texels& texels);

/// One track, lossless.
EncodedTexture storeTexture(const Texels& texels);

}  // namespace tetrakis
