// SPDX-License-Identifier: Apache-2.0
// Geometry track to height field. Integer only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis {

struct DecodedGeometry {
  std::vector<int32_t> heights;      ///< width * height, row by row
  std::vector<uint8_t> significant;  ///< 1 where the vertex has a non-zero coefficient
};

/// codeword: any prefix of a geometry track with `planes` bit-planes (0..30). Safe on any bytes.
DecodedGeometry decodeGeometry(std::span<const uint8_t> codeword, int planes, uint32_t width,
                               uint32_t height);

/// Drops the fraction bits of heights (GeometryHeader::fraction_bits), rounding half up.
void dropFraction(std::vector<int32_t>& heights, int bits);

}  // namespace tetrakis
