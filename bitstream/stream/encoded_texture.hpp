// SPDX-License-Identifier: Apache-2.0
// A texture as its codec has coded it: what the header says of it, and its tracks.
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
};

}  // namespace tetrakis
