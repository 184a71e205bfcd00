// SPDX-License-Identifier: Apache-2.0
// TrackMemory keeps what calls of a decoder have decoded of tracks, so that later ones pay only for
// what is new: more bytes of a track, another window, or more bands of the same region.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/kept_items.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_decoder.hpp"
#include "codec/wavelet/band_plan.hpp"

namespace tetrakis::inline wavelet {

/// The bytes of all codewords together.
uint64_t bytesOf(const Codewords& codewords);

/// What one call of a decoder leaves to the next, whose tracks begin with the same bytes. It is
/// empty before the first call.
struct TrackMemory {
  KeptItems<GrowingTrack> tracks;
  std::optional<SynthesisNorms> norms = {};  ///< of all of them
  bool all_levels = false;                   ///< for calls with views of several levels
  /// No track is left to the next call: states of all tracks together take twice the memory of a
  /// plane, and those of one track at a time nearly none.
  bool forgets = false;
  /// Where there is but one track and calls have its whole codeword, only the passes count that
  /// begin within so many bytes of it. Encoders look at prefixes in this way.
  std::optional<uint64_t> passes_within = {};

  /// What calls know of these codewords.
  uint64_t knownBytes(const Codewords& codewords) const;
  uint64_t bytes() const { return tracks.bytes(); }

  /// A track of which nothing is known. plan: with what the view needs.
  GrowingTrack begun(std::vector<BandPlan> plan, int planes) const;
  const TrackState& decode(GrowingTrack& track, std::span<const uint8_t> codeword) const;
};

}  // namespace tetrakis::inline wavelet
