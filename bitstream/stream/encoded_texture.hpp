// SPDX-License-Identifier: Apache-2.0
// EncodedTexture is the result of encoding a texture: its tracks, and the part of the header that
// describes them.
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
