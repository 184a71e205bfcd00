// SPDX-License-Identifier: Apache-2.0
// encodeCoefficients() and encodeStoredHeights() turn heights into tracks of wavelet coefficients
// or into their samples as they are, which heights_decoder.hpp decodes; prefixesOfCorrections()
// gives the heights behind prefixes of corrections.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/wavelet/priority_map.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline geometry {

// encodeCoefficients() transforms heights in steps and codes their coefficients into tracks.

struct CoefficientOptions {
  uint64_t limit = UINT64_MAX;      ///< bytes worth coding, of all tracks together
  int region_log2 = 0;              ///< bitstream/track/track.hpp; 0: one track
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

// encodeStoredHeights() writes the samples of heights without coding them, where no coder takes
// fewer bytes.

/// Returns how many bytes storing the valid samples takes.
uint64_t storedBytes(const tks_heights& heights, size_t valid_samples);

/// Returns the codeword of the valid samples.
std::vector<uint8_t> encodeStoredHeights(const tks_heights& heights, Mask valid);

// prefixesOfCorrections() gives the heights behind each prefix of their corrections, for encoders
// that measure many prefixes. It corrects all samples once instead of decoding each prefix anew.

/// Returns a function for the memory of decodeHeights() (heights_decoder.hpp), which shows the same
/// heights with it as without: those of the first bytes of the track, where `bytes` bytes of
/// corrections, 1 or more, follow the whole coefficients. track: the only one of the heights, which
/// have corrections, as an encoder wrote it; it and the headers outlive the result. The work begins
/// at the first call.
std::function<DecodedHeights(uint64_t bytes)> prefixesOfCorrections(const GeometryHeader& header,
                                                                    const GeometryLayers& layers,
                                                                    std::span<const uint8_t> track);

}  // namespace tetrakis::inline geometry
