// SPDX-License-Identifier: Apache-2.0
// specOf() and the other functions here turn the fields of a stream header about the wavelet into
// the arguments of the transform.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/coding_headers.hpp"
#include "codec/wavelet/wavelet_spec.hpp"

namespace tetrakis::inline wavelet {

inline WaveletSpec specOf(const WaveletHeader& header) {
  WaveletSpec spec;
  std::transform(header.filters.begin(), header.filters.end(), spec.filters.begin(),
                 [](uint8_t id) { return static_cast<FilterId>(id); });
  spec.whole = header.fraction_bits == 0;
  spec.bits = header.bits;
  spec.first_doubled = header.first_doubled;
  spec.ring = header.ring;
  return spec;
}

/// Values as the transform takes them.
inline std::vector<int32_t> withFractions(std::span<const int32_t> values, int fraction_bits) {
  std::vector<int32_t> scaled(values.begin(), values.end());
  for (int32_t& value : scaled) value <<= fraction_bits;
  return scaled;
}

/// The binary places of coefficients of samples without fraction bits in an inverse that is not to
/// restore them: as many as fit.
inline int unroundedBits(int bit_planes) {
  return std::clamp(19 - bit_planes, 0, 4);
}

/// The fraction bits that values have in the inverse down to a mip level: those of the header, or,
/// if it has none and so much is unknown that roundings would add to it, as many as fit. Mip levels
/// above 0 are never rounded: details that they do not know made the fractions that they are made
/// of. bytes: of the coefficients, in all tracks together.
inline int fractionBitsOf(const WaveletHeader& header, int bit_planes, uint64_t bytes, int level) {
  if (header.fraction_bits > 0) return header.fraction_bits;
  return level == 0 && bytes >= header.rounded_bytes ? 0 : unroundedBits(bit_planes);
}

}  // namespace tetrakis::inline wavelet
