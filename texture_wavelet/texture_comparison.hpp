// SPDX-License-Identifier: Apache-2.0
// showsBetter() decides from the accounts of two encodings of an image, without decoding them,
// which of them is better. Encoder only.
#pragma once

#include <cstdint>

#include "bitstream/stream/encoded_texture.hpp"
#include "texture_wavelet/texture_source.hpp"

namespace tetrakis::inline texture {

/// Bytes of all tracks, and of the tables in the header.
uint64_t bytesOf(const EncodedTexture& encoded);

/// Whether a shows the image better than b where they will be cut: in fewer bytes if there is an
/// error aimed at, or if both are whole, else by less error in as many bytes. What shorter prefixes
/// show counts as well, least where somebody asks for an error. samples: that count.
bool showsBetter(const EncodedTexture& a, const EncodedTexture& b, const TextureOptions& options,
                 uint64_t samples);

}  // namespace tetrakis::inline texture
