// SPDX-License-Identifier: Apache-2.0
// Geometry track to height field. Integer only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis {

struct DecodedGeometry {
  std::vector<int32_t> heights;      ///< width * height, row by row; 0 where voids are
  std::vector<uint8_t> significant;  ///< 1 where the vertex has a non-zero coefficient
  std::vector<uint8_t> valid;        ///< 1 valid, 0 void; empty: all are valid
};

/// codeword: any prefix of a geometry track's coefficients, of `planes` bit-planes (0..30). valid:
/// width * height, or empty. Safe on any bytes.
DecodedGeometry decodeGeometry(std::span<const uint8_t> codeword, int planes, uint32_t width,
                               uint32_t height, std::vector<uint8_t> valid = {});

/// Drops the fraction bits of heights (GeometryHeader::fraction_bits), rounding half up.
void dropFraction(std::vector<int32_t>& heights, int bits);

}  // namespace tetrakis
