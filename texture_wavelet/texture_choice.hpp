// SPDX-License-Identifier: Apache-2.0
// encodeTexture() codes an image by the coder that suits it: drawings colour by colour, photographs
// by wavelet, and images that no coder makes smaller sample by sample.
#pragma once

#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis::inline texture {

/// Codes the image by wavelet; or it is drawn or stored, in one track, where that is better.
/// Complete tracks without fraction bits that hide nothing are lossless.
EncodedTexture encodeTexture(const TextureSource& source, Purpose purpose, TextureOptions options);

/// The image that was coded by wavelet with the header `lossy`, to the last bit, with its colours
/// and filters: so prefixes are nearly as good. That takes 4 % more bytes than colours and filters
/// that suit the last bit.
EncodedTexture encodeReversibly(const TextureSource& source, TextureHeader lossy,
                                const TextureOptions& options);

}  // namespace tetrakis::inline texture
