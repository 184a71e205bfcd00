// SPDX-License-Identifier: Apache-2.0
// RegionDecoder decodes the tracks of a component one region after the other, or on several
// threads. Each thread keeps the state of one region only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/view.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/track_memory.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline wavelet {

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

  /// The bytes that the largest track takes at most, on each thread; or that all take, if they are
  /// kept.
  uint64_t bytes() const;

 private:
  uint64_t ofForest() const;
  uint64_t ofBands(const std::vector<BandPart>& parts) const;  ///< of the bands alone
};

/// What a component says about the bands of its tracks.
struct TrackBands {
  /// Of each part of a track's region whether the view needs it; none if it needs none.
  std::function<std::vector<bool>(size_t track)> needs;
  /// One or more planes of as many bands.
  std::function<std::vector<BandPlan>(size_t track)> plan;
};

/// What the header says about the tracks of a component.
struct RegionDecoder {
  const WaveletHeader& wavelet;
  const RegionHeader& regions;
  int bit_planes;
  int level;  ///< of the view
  DecodeContext<TrackMemory> context;

  /// Takes what is known of a track, with `more_bits` binary places more than it was coded with.
  /// It is not called for tracks of which nothing is known: all their coefficients are 0. It may be
  /// called for different tracks at the same time.
  using Take = std::function<void(size_t track, const TrackState& state, int more_bits)>;

  /// True if there is only one track and nothing is known of it, so that run() takes none.
  bool nothingKnown(const Codewords& codewords) const;

  /// Returns the fraction bits of the values taken (docs/FORMAT.md, section 7).
  int run(const Codewords& codewords, const TrackBands& bands, const Take& take) const;
};

}  // namespace tetrakis::inline wavelet
