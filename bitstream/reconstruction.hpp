// SPDX-License-Identifier: Apache-2.0
// Where in its known interval a coefficient is most likely to lie. Bit-planes leave an interval; its
// middle is not the best guess, because small magnitudes are more frequent, the more so where the
// neighbourhood is quiet, and because neighbours along the band's direction tend to alternate in
// sign. The rules cost no bytes: against 7/16 of the interval they save 2 to 4 %.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/band.hpp"

namespace tetrakis {

/// The band's coefficients, rows * columns, row by row, in units of 2^-fraction_bits (0 to 8).
/// Coefficients known to the last bit come out exactly, times 2^fraction_bits.
void reconstruct(const Band& band, int fraction_bits, std::vector<int32_t>& values);

/// Reconstruction point of a magnitude known down to bit-plane `plane`, not knowing its
/// neighbours: what the encoder counts its distortion with.
inline uint32_t typicalMagnitude(uint32_t magnitude, int plane) {
  return magnitude == 0 ? 0 : magnitude + (((uint32_t{1} << plane) * 7) >> 4);
}

}  // namespace tetrakis
