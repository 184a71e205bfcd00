// SPDX-License-Identifier: Apache-2.0
// TrackMemory keeps what calls of a decoder have decoded of tracks, so that later ones pay only for
// what is new: more bytes of a track, another window, or more bands of the same region.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_decoder.hpp"
#include "codec/wavelet/band_plan.hpp"

namespace tetrakis::inline wavelet {

/// The bytes of all codewords together.
uint64_t bytesOf(const Codewords& codewords);

/// What one call of a decoder leaves to the next, whose tracks begin with the same bytes. It is
/// empty before the first call.
class TrackMemory {
 public:
  std::optional<SynthesisNorms> norms;  ///< of all tracks
  bool all_levels = false;              ///< for calls with views of several levels
  /// No track is left to the next call: states of all tracks together take twice the memory of a
  /// plane, and those of one track at a time nearly none.
  bool forgets = false;
  /// The tracks together never take more, but for those that are decoded at a time. Those go first
  /// that no call has used for longest.
  uint64_t most_bytes = UINT64_MAX;
  /// Where there is but one track and calls have its whole codeword, only the passes count that
  /// begin within so many bytes of it. Encoders look at prefixes in this way.
  std::optional<uint64_t> passes_within = {};

  /// What calls know of these codewords.
  uint64_t knownBytes(const Codewords& codewords) const;
  uint64_t bytes() const;

  // Of a track, of which only one thread speaks at a time, in a call that has a Room.
  bool knows(size_t track) const { return tracks_[track].has_value(); }
  void begin(size_t track, std::vector<BandPlan> plan, int planes);
  void need(size_t track, const std::vector<bool>& parts) { tracks_[track]->need(parts); }
  const TrackState& decode(size_t track, std::span<const uint8_t> codeword);

  /// What there is room for in one call, whose threads share it.
  class Room {
   public:
    /// memory: null: there is nothing to keep. Forgets old tracks where much is kept.
    Room(TrackMemory* memory, size_t tracks);

    /// A track that was decoded stays, or is forgotten because there is no room.
    void keepIfFits(size_t track);

   private:
    TrackMemory* memory_;
    std::atomic<uint64_t> bytes_;
  };

 private:
  void forgetOldest(uint64_t most);

  std::vector<std::optional<GrowingTrack>> tracks_;
  std::vector<uint64_t> kept_;  ///< bytes of each
  std::vector<uint64_t> used_;  ///< the last call that used it
  uint64_t calls_ = 0;
};

}  // namespace tetrakis::inline wavelet
