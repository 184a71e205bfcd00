// SPDX-License-Identifier: Apache-2.0
// encodeCoefficients() transforms heights in steps and codes their coefficients into tracks.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "codec/wavelet/priority_map.hpp"

namespace tetrakis::inline geometry {

struct CoefficientOptions {
  uint64_t limit = UINT64_MAX;      ///< bytes worth coding, of all tracks together
  int region_log2 = 0;              ///< bitstream/track/regions.hpp; 0: one track
  uint32_t threads = 1;             ///< nothing depends on them
  double share = 1;                 ///< that the error counts: HeightSteps::liftedShare()
  bool windows = false;             ///< withShortReach()
  const FlatAreas* flat = nullptr;  ///< areas that are known, and not coded; null: there are none
  /// The coefficients that come earlier; null: none do.
  const PriorityMap* priorities = nullptr;
  /// Squared error in steps, of all samples together, below which coding ends.
  double enough = TrackOptions::kNever;
};

/// Codes heights in steps, with the mask of the samples that are lifted. Returns one track for each
/// of regionsOf(). wavelet: from chooseWavelet(). Distortion is in squared units of the heights,
/// summed over the samples that are lifted and multiplied by the share.
std::vector<EncodedTrack> encodeCoefficients(const PlaneView<const int32_t>& heights,
                                             const WaveletHeader& wavelet,
                                             const CoefficientOptions& options);

}  // namespace tetrakis::inline geometry
