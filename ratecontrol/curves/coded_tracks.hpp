// SPDX-License-Identifier: Apache-2.0
// CodedTracks is a coded component as rate control sees it: codewords with their accounts, whether
// they hold heights or texels.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis::inline curves {

struct CodedTracks {
  Component component = Component::kGeometry;
  std::span<const EncodedTrack> tracks;  ///< at least one; they outlive this
  uint64_t opening = 0;           ///< bytes of the first track that come before everything else
  uint64_t correction_bytes = 0;  ///< those that come behind everything else
  size_t correction_tracks = 0;   ///< the last ones, which do so as well
};

/// All codewords, in the order of the tracks, which they refer to.
Codewords codewordsOf(std::span<const EncodedTrack> tracks);

/// Squared error that an account states after `bytes` bytes; linear between its points.
double distortionAt(std::span<const RatePoint> points, uint64_t bytes);

/// The codewords that a decoder has after the first `bytes` payload bytes of the component's
/// packets. packets: all of the component's in their order; packets of other components among them
/// are skipped.
Codewords prefixAfter(const CodedTracks& coded, std::span<const Packet> packets, uint64_t bytes);

}  // namespace tetrakis::inline curves
