// SPDX-License-Identifier: Apache-2.0
// ShownSignificance marks the vertices of a view that have a significant coefficient. They make the
// coded mesh of that view.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/view.hpp"
#include "bitstream/track/track_decoder.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/pyramid.hpp"

namespace tetrakis::inline geometry {

/// Collects the marks of vertices from the tracks of a view. The pyramid outlives it.
class ShownSignificance {
 public:
  ShownSignificance(const Pyramid& pyramid, const View& view, size_t tracks);

  /// Takes the bands of a track. Called for different tracks at the same time.
  void take(size_t track, const TrackState& state, std::span<const BandPart> parts);

  /// Writes the marks of the vertices, and the number of finest levels without a mark, into the
  /// heights of the view.
  void giveTo(DecodedGeometry& geometry);

 private:
  void mark(const Band& band, const Subband& subband, const BandPart& part);

  const Pyramid& pyramid_;
  int level_;
  const LowBand& low_;
  Window shown_;  ///< samples of the low band
  bool is_window_;
  std::vector<uint8_t> marks_;  ///< of those
  std::vector<int> quiet_;      ///< of each track, the finest levels without such a coefficient
};

}  // namespace tetrakis::inline geometry
