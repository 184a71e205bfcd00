// SPDX-License-Identifier: Apache-2.0
// Geometry track to height field. Integer only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/header.hpp"

namespace tetrakis {

struct DecodedGeometry {
  std::vector<int32_t> heights;  ///< width * height, row by row, in units of 2^-fraction_bits steps
  int fraction_bits = 0;
};

/// codeword: any prefix of a geometry track. Safe on any bytes and any header that readHeader
/// accepts.
DecodedGeometry decodeGeometry(const GeometryHeader& header, std::span<const uint8_t> codeword);

/// Heights in whole steps, rounding half up.
std::vector<int32_t> wholeSteps(DecodedGeometry decoded);

}  // namespace tetrakis
