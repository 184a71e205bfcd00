// SPDX-License-Identifier: Apache-2.0
// Tetrakis through its C interface: one lossless stream, and every operating point a cut of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/peers/peer.hpp"

namespace tetrakis::bench {

enum class RasterKind { kHeights, kImage };

/// The tracks of one stream; either may be null. Heights are given as 16-bit, images as 8-bit
/// samples.
struct StreamSource {
  const Raster* heights = nullptr;
  const Raster* image = nullptr;
  tks_weights weights = TKS_WEIGHTS_PSNR;
};

/// bytes: size of the whole stream; 0: lossless.
Result<std::vector<uint8_t>> encodeTetrakis(const StreamSource& source, uint64_t bytes);

/// A decoded prefix; a track that the stream lacks is empty.
struct DecodedStream {
  std::vector<uint16_t> heights;
  std::vector<float> surface;  ///< the heights between the steps, in sample steps
  std::vector<uint16_t> image;
  uint64_t geometry_bytes = 0, texture_bytes = 0;  ///< payload of either track in the prefix
};

/// TKS_TRUNCATED when the prefix is too short to hold the stream's header.
Result<DecodedStream> decodeTetrakis(std::span<const uint8_t> prefix);

/// The same for its samples alone, as they were given: what is timed.
Status decodeTetrakisSamples(std::span<const uint8_t> stream);

class TetrakisPeer : public Peer {
 public:
  explicit TetrakisPeer(RasterKind kind) : kind_(kind) {}
  std::string name() const override { return "tetrakis"; }
  Result<PeerCurves> curves(const Raster& raster,
                            const std::vector<uint64_t>& targets) const override;

 private:
  RasterKind kind_;
};

}  // namespace tetrakis::bench
