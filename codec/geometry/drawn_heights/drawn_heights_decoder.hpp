// SPDX-License-Identifier: Apache-2.0
// decodeDrawnHeights() decodes drawn heights: steps coded as they are, vertex by vertex of the
// lattice (codec/drawing/drawing_pass.hpp), in the place of coefficients. It uses integers only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/drawn_heights/drawn_surface.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline drawn_heights {

/// Decodes the heights of a view. For a level only its vertices are decoded; for a window all
/// vertices are, but only those that the window needs get heights. codeword: any prefix of the
/// codeword of a geometry with header.drawn. valid: of the whole plane. Safe on any bytes.
DecodedGeometry decodeDrawnHeights(const GeometryHeader& header, std::span<const uint8_t> codeword,
                                   const SharedBits& valid, const View& view);

/// The heights of the shown part of a surface.
DecodedGeometry decodedHeights(const DrawnSurface& surface);

}  // namespace tetrakis::inline drawn_heights
