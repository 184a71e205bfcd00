// SPDX-License-Identifier: Apache-2.0
// Decodes drawn heights: steps coded as they are, vertex by vertex of the lattice
// (codec/drawing/drawing_pass.hpp), in the place of coefficients. Integer arithmetic only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/drawn_heights/drawn_surface.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline drawn_heights {

/// Decodes the vertices at multiples of 2^level alone. codeword: any prefix of that of a geometry
/// with header.drawn. valid: of the whole plane; empty: all are valid. Safe on any bytes.
DecodedGeometry decodeDrawnHeights(const GeometryHeader& header, std::span<const uint8_t> codeword,
                                   const std::vector<uint8_t>& valid, int level);

/// What a surface shows. valid: of its plane, as above.
DecodedGeometry decodedHeights(const DrawnSurface& surface, std::vector<uint8_t> valid);

}  // namespace tetrakis::inline drawn_heights
