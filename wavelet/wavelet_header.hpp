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
  spec.whole = header.fraction_bits == 0;
  spec.bits = header.bits;
  spec.first_doubled = header.first_doubled;
  return spec;
}

/// The binary places of coefficients of samples without fraction bits in an inverse that does not
/// round: as many as fit.
inline int unroundedBits(int bit_planes) {
  return std::clamp(19 - bit_planes, 0, 4);
}

/// Returns how many binary places the coefficients get when they are reconstructed: those of the
/// header, or, if it has none and so much is unknown that roundings would add to it, as many as
/// fit. bytes: of the coefficients, in all tracks together.
inline int outputFractionBits(const WaveletHeader& header, int bit_planes, uint64_t bytes) {
  const bool rounds = header.fraction_bits > 0 || bytes >= header.rounded_bytes;
  return rounds ? header.fraction_bits : unroundedBits(bit_planes);
}

}  // namespace tetrakis::inline wavelet
