// SPDX-License-Identifier: Apache-2.0
// Image to texture track.
#pragma once

#include <cstdint>

#include "bitstream/header.hpp"
#include "bitstream/track_encoder.hpp"
#include "texture_wavelet/texels.hpp"
#include "wavelet/filter_choice.hpp"

namespace tetrakis {

struct EncodedTexture {
  TextureHeader header;
  EncodedTrack track;  ///< distortion: squared error summed over all samples of all channels
};

/// By wavelet, or drawn where that is better. Coding stops soon after `limit` bytes, of which half
/// are what a budget has room for. A complete track without fraction bits is lossless.
EncodedTexture encodeTexture(const Texels& texels, Purpose purpose, uint64_t limit);

}  // namespace tetrakis
