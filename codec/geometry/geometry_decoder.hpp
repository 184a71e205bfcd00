// SPDX-License-Identifier: Apache-2.0
// Geometry tracks to height field. Integer only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"
#include "wavelet/region_decoder.hpp"
#include "wavelet/window.hpp"

namespace tetrakis {

struct DecodedGeometry {
  uint32_t width = 0, height = 0;
  /// width * height, row by row, in units of 2^-fraction_bits steps; 0 where voids are
  std::vector<int32_t> heights;
  int fraction_bits = 0;
  std::vector<uint8_t> significant;  ///< 1 where the vertex has a non-zero coefficient
  std::vector<uint8_t> valid;        ///< 1 valid, 0 void; empty: all are valid
  uint32_t quiet_levels = 0;         ///< finest levels of which no coefficient is significant
};

/// codewords: any prefix of the coefficients of each track, one for each of regionsOf(). valid:
/// width * height, or empty. level: every 2^level-th sample in x and y, up to the coarsest
/// (wavelet/mip_level.hpp). Safe on any bytes and any header that readHeader accepts. memory: of
/// the calls before, with the same header, validity and level.
DecodedGeometry decodeGeometry(const GeometryHeader& header, const Codewords& codewords,
                               std::vector<uint8_t> valid = {}, int level = 0, uint32_t threads = 1,
                               TrackMemory* memory = nullptr);

/// The same in a window of the plane, in time that follows its size where there are regions. valid:
/// of the whole plane; out of it come the heights and the validity of the window alone.
DecodedGeometry decodeGeometryWindow(const GeometryHeader& header, const Codewords& codewords,
                                     std::span<const uint8_t> valid, const Window& window,
                                     uint32_t threads = 1);

/// A height in units of 2^-fraction_bits steps in whole steps, rounding half up.
inline int32_t wholeStep(int32_t height, int fraction_bits) {
  const int some = fraction_bits > 0;
  return (height >> fraction_bits) + ((height >> (fraction_bits - some)) & some);
}

/// All heights in whole steps.
std::vector<int32_t> wholeSteps(const DecodedGeometry& decoded);

}  // namespace tetrakis
