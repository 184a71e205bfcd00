// SPDX-License-Identifier: Apache-2.0
// RegionDecoder decodes the tracks of a component one region after the other, or on several
// threads. Each thread keeps the state of one region only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/view.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_decoder.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline wavelet {

/// What one call of a decoder leaves to the next, whose tracks begin with the same bytes: one for
/// each track of which something is known. It is empty before the first call.
struct TrackMemory {
  std::vector<std::optional<GrowingTrack>> tracks;
  std::optional<SynthesisNorms> norms;  ///< of all of them
  bool all_levels = false;              ///< for calls with views of several levels
  /// No track is left to the next call: states of all tracks together take twice the memory of a
  /// plane, and those of one track at a time nearly none.
  bool forgets = false;
  /// Where there is but one track and calls have its whole codeword, only the passes count that
  /// begin within so many bytes of it. Encoders look at prefixes in this way.
  std::optional<uint64_t> passes_within = {};

  /// What calls know of these codewords.
  uint64_t knownBytes(const Codewords& codewords) const;
  const TrackState& decode(size_t track, std::span<const uint8_t> codeword);
  uint64_t bytes() const;
};

/// What RegionDecoder::run() needs for the tracks of a component.
struct TrackNeeds {
  Extent plane;
  const Forest* forest;  ///< whose raster the plane is; null: it is a grid
  int side_log2;         ///< of the regions; 0: there is one track
  uint32_t planes;       ///< that a track has bands of: 1, or the colour planes of a texture
  bool masked;           ///< some samples do not exist, and their coefficients are absent
  bool ordered;          ///< coefficients have priorities
  bool known;            ///< there may be a byte of a track
  uint32_t threads;
  bool kept;  ///< in a TrackMemory

  /// The bytes that the largest track takes at most, on each thread; or that all take, each
  /// with a copy of its largest band, if they are kept.
  uint64_t bytes() const;

 private:
  uint64_t ofForest() const;
  /// Of the bands alone; largest grows to the bytes of the largest one.
  uint64_t ofBands(const std::vector<BandPart>& parts, uint64_t& largest) const;
};

/// What the header says about the tracks of a component.
struct RegionDecoder {
  const WaveletHeader& wavelet;
  const RegionHeader& regions;
  int bit_planes;
  int level;  ///< of the view
  DecodeContext<TrackMemory> context;

  /// Returns the plan of a track, or an empty one if the track is not wanted.
  using PlanOf = std::function<std::vector<BandPlan>(size_t track)>;
  /// Takes what is known of a track, with `more_bits` binary places more than it was coded with.
  /// It is not called for tracks of which nothing is known: all their coefficients are 0. It may be
  /// called for different tracks at the same time.
  using Take = std::function<void(size_t track, const TrackState& state, int more_bits)>;

  /// True if there is only one track and nothing is known of it, so that run() takes none.
  bool nothingKnown(const Codewords& codewords) const;

  /// Returns the fraction bits of the values taken (docs/FORMAT.md, section 7).
  int run(const Codewords& codewords, const PlanOf& plan_of, const Take& take) const;
};

}  // namespace tetrakis::inline wavelet
