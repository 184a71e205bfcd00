// SPDX-License-Identifier: Apache-2.0
// This is what the codec of textures makes of one: its tracks, and what the header says of them.
#pragma once

#include <vector>

#include "bitstream/stream/texture_header.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis::inline stream {

struct EncodedTexture {
  TextureHeader header;
  /// Distortion: squared error summed over the samples that count.
  std::vector<EncodedTrack> tracks;
};

}  // namespace tetrakis::inline stream
