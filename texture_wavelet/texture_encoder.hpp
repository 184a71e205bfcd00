// SPDX-License-Identifier: Apache-2.0
// Image to texture tracks.
#pragma once

#include <vector>

#include "bitstream/header.hpp"
#include "bitstream/track_encoder.hpp"
#include "texture_wavelet/texels.hpp"
#include "wavelet/filter_choice.hpp"

namespace tetrakis {

struct EncodedTexture {
  TextureHeader header;
  /// Distortion: squared error summed over all samples of all channels.
  std::vector<EncodedTrack> tracks;
};

/// Complete tracks without fraction bits are lossless.
EncodedTexture encodeTexture(const Texels& texels, Purpose purpose, const TrackOptions& options);

}  // namespace tetrakis
