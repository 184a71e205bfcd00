// SPDX-License-Identifier: Apache-2.0
// encodeStoredTexture() writes the samples of an image without coding them, where no coder takes
// fewer bytes.
#pragma once

#include "base/texels.hpp"
#include "bitstream/stream/encoded_texture.hpp"

namespace tetrakis::inline texture {

/// Bytes that storing takes.
uint64_t storedBytes(const Texels& texels);

/// One track, lossless.
EncodedTexture encodeStoredTexture(const Texels& texels);

}  // namespace tetrakis::inline texture
