// SPDX-License-Identifier: Apache-2.0
// Decodes the tracks of a component one region after the other, or on several threads, so that the
// state of no more than one region a thread is kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/track/track_decoder.hpp"
#include "wavelet/band_plan.hpp"

namespace tetrakis {

/// What one call of a decoder leaves to the next, whose only track is longer by some bytes, and
/// starts in the same memory. Empty at first.
using TrackMemory = std::optional<GrowingTrack>;

/// What run() below needs for the tracks of planes.
struct TrackNeeds {
  uint32_t width, height;
  int side_log2;
  uint32_t components;
  bool masked;  ///< coefficients may be absent
  bool known;   ///< there may be a byte of one
  uint32_t threads;

  /// Bytes at most: of the largest track, on each thread.
  uint64_t bytes() const;
};

/// What the header says about the tracks of a component.
struct RegionDecoder {
  const WaveletHeader& wavelet;
  const RegionHeader& regions;
  int planes;
  uint32_t threads;

  /// The plan of a track; empty: it is not wanted.
  using PlanOf = std::function<std::vector<BandPlan>(size_t track)>;
  /// Takes what is known of a track, with so many binary places more than it was coded with.
  /// Tracks of which nothing is known are left out: all their coefficients are 0. Called for
  /// different tracks at the same time.
  using Take = std::function<void(size_t track, const TrackState& state, int more_bits)>;

  /// There is one track, of which nothing is known: run() takes none.
  bool nothingKnown(const Codewords& codewords) const;

  /// Returns the fraction bits of the values taken (docs/FORMAT.md, section 7).
  int run(const Codewords& codewords, const PlanOf& plan_of, const Take& take,
          TrackMemory* memory = nullptr) const;
};

}  // namespace tetrakis
