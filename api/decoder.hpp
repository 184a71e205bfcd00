// SPDX-License-Identifier: Apache-2.0
// What a tks_decoder holds.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "api/height_layers.hpp"
#include "bitstream/header.hpp"
#include "bitstream/packet.hpp"

struct tks_decoder {
  std::span<const uint8_t> data;  ///< the caller's
  tetrakis::ParsedHeader parsed;
  tetrakis::Demultiplexed payload;
  int heights_level = 0, texture_level = 0;
  std::optional<tetrakis::DecodedHeights> heights;  ///< of that level, decoded on first use
  uint32_t threads = 1;
  std::string message;
};

namespace tetrakis {

/// Decoded once. TKS_USAGE if the stream holds none.
Result<const DecodedHeights*> decodedHeights(tks_decoder& decoder);

/// Of these, the heights between the steps.
Result<const DecodedGeometry*> decodedGeometry(tks_decoder& decoder);

/// Height in the unit = heights value * scale + offset.
struct SurfaceScale {
  double scale, offset;
};
SurfaceScale surfaceScale(const StreamHeader& header, const DecodedGeometry& geometry);

}  // namespace tetrakis
