// SPDX-License-Identifier: Apache-2.0
// What an encoder makes of a texture.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis {

struct EncodedTexture {
  TextureHeader header;
  /// Distortion: squared error summed over the samples that count.
  std::vector<EncodedTrack> tracks;
  /// Where colours are hidden, 1 for each texel whose colours are not; else empty.
  std::vector<uint8_t> seen = {};
};

}  // namespace tetrakis
