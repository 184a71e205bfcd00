// SPDX-License-Identifier: Apache-2.0
// What a tks_decoder holds, and what the files that work on it share.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "api/message.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"
#include "codec/geometry/height_layers.hpp"
#include "wavelet/mip_level.hpp"

struct tks_decoder {
  std::span<const uint8_t> data;  ///< the caller's
  tetrakis::ParsedHeader parsed;
  tetrakis::Demultiplexed payload;
  int heights_level = 0, texture_level = 0;
  std::optional<tetrakis::DecodedHeights> heights;  ///< of that level, decoded on first use
  uint32_t threads = 1;
  uint64_t max_memory = 0;     ///< of the decoder and any call
  uint64_t payload_bytes = 0;  ///< that `payload` takes, at most
  std::string message;
};

namespace tetrakis {

/// Decoded once. TKS_USAGE if the stream holds none.
Result<const DecodedHeights*> decodedHeights(tks_decoder& decoder);

/// Of these, the heights between the steps.
Result<const DecodedGeometry*> decodedGeometry(tks_decoder& decoder);

/// TKS_USAGE, with their sentences.
Status wrongSize(uint64_t wanted, uint64_t given);
Status noHeights();
Status noTexture();

/// TKS_USAGE unless the window lies inside level 0 of a component of that size.
Status checkWindow(const tks_window* window, uint32_t width, uint32_t height, int level);

/// Height in the unit = heights value * scale + offset.
struct SurfaceScale {
  double scale, offset;
};
SurfaceScale surfaceScale(const StreamHeader& header, const DecodedGeometry& geometry);

/// The coarsest mip level of the heights or the texture of a header; 0 where there are none.
inline int coarsestLevels(const auto& part) {
  return part ? MipLevel::coarsestLevel(part->width, part->height) : 0;
}

/// Runs f and keeps its sentence in the decoder.
template <class F>
tks_status keeping(tks_decoder* decoder, F&& f) {
  if (decoder == nullptr) return TKS_USAGE;
  const Status status = guarded(f);
  decoder->message = status.message();
  return status.code();
}

}  // namespace tetrakis
