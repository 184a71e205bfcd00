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
  std::optional<tetrakis::DecodedGeometry> geometry;  ///< decoded on first use, in whole steps
  std::string message;
};

namespace tetrakis {

/// Heights in whole steps, decoded once. TKS_USAGE if the stream holds none.
Result<const DecodedGeometry*> decodedGeometry(tks_decoder& decoder);

}  // namespace tetrakis
