// SPDX-License-Identifier: Apache-2.0
// The functions here translate what a stream header says about the wavelet for the transform.
#pragma once

#include <algorithm>

#include "bitstream/stream/header.hpp"
#include "wavelet/wavelet.hpp"

namespace tetrakis::inline wavelet {

inline WaveletSpec specOf(const WaveletHeader& header) {
  WaveletSpec spec;
  std::transform(header.filters.begin(), header.filters.end(), spec.filters.begin(),
                 [](uint8_t id) { return static_cast<FilterId>(id); });
  spec.doubled = header.fraction_bits == 0;
  spec.bits = header.bits;
  return spec;
}

/// Returns how many binary places the coefficients of a track get when they are reconstructed:
/// those of the header, or, if it has none and the track is incomplete, as many as fit, so that the
/// inverse transform adds no rounding noise of its own.
inline int outputFractionBits(const WaveletHeader& header, int bit_planes, bool complete) {
  if (header.fraction_bits > 0 || complete) return header.fraction_bits;
  return std::clamp(19 - bit_planes, 0, 4);
}

}  // namespace tetrakis::inline wavelet
