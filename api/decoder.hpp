// SPDX-License-Identifier: Apache-2.0
// What a tks_decoder holds.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bitstream/header.hpp"
#include "bitstream/packet.hpp"
#include "codec/geometry_decoder.hpp"

struct tks_decoder {
  std::span<const uint8_t> data;  ///< the caller's
  tetrakis::ParsedHeader parsed;
  tetrakis::Demultiplexed payload;
  std::optional<tetrakis::DecodedGeometry> geometry;  ///< decoded on first use, with fraction bits
  std::string message;
};

namespace tetrakis {

/// Heights in steps * 2^fraction_bits, decoded once. TKS_USAGE if the stream holds none.
Result<const DecodedGeometry*> decodedGeometry(tks_decoder& decoder);

/// Height in the unit = heights value * scale + offset.
struct SurfaceScale {
  double scale, offset;
};
SurfaceScale surfaceScale(const StreamHeader& header);

}  // namespace tetrakis
