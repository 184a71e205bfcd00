// SPDX-License-Identifier: Apache-2.0
// prefixesOfDrawing() gives the heights that each prefix of a drawing shows, for encoders that
// measure many prefixes. It decodes the drawing once.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline drawn_heights {

/// Returns a function that gives the same heights as decodeDrawnHeights() of the first bytes of the
/// codeword at level 0, in less time. codeword: all of it, as an encoder wrote it. valid: of the
/// plane.
std::function<DecodedGeometry(uint64_t bytes)> prefixesOfDrawing(const GeometryHeader& header,
                                                                 std::span<const uint8_t> codeword,
                                                                 Mask valid);

}  // namespace tetrakis::inline drawn_heights
