// SPDX-License-Identifier: Apache-2.0
// This file transforms heights in steps and codes their coefficients into the geometry's tracks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis {

/// Heights in steps, row by row; the spans outlive it.
struct HeightPlane {
  std::span<const int32_t> heights;
  uint32_t width = 0, height = 0;
  std::span<const uint8_t> valid = {};  ///< 1 valid, 0 void, one a height; empty: all are valid
};

struct CoefficientOptions {
  uint64_t limit = UINT64_MAX;  ///< bytes worth coding, of all tracks together
  int region_log2 = 0;          ///< bitstream/track/regions.hpp; 0: one track
  uint32_t threads = 1;         ///< nothing depends on them
};

/// wavelet: from chooseWavelet(). Distortion is in squared height units, summed over the samples.
std::vector<EncodedTrack> encodeCoefficients(const HeightPlane& plane, const WaveletHeader& wavelet,
                                             const CoefficientOptions& options);

}  // namespace tetrakis
