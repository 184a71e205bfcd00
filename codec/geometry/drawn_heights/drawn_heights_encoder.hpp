// SPDX-License-Identifier: Apache-2.0
// encodeDrawnHeights() codes heights in steps as a drawing. estimateDrawing() foretells how many
// bytes the drawing takes, and prefixesOfDrawing() gives the heights that its prefixes show.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/drawing/drawing_encoding.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline drawn_heights {

// estimateDrawing() foretells how many bytes a drawing of heights takes, at a small part of the
// time of drawing them.

/// About how many bytes the steps take as a drawing. Drawings take 0.7 to 1.05 times this number;
/// drawn terrain takes 1.7 times.
inline double estimateDrawing(const PlaneView<const int32_t>& heights) {
  return estimateDrawing(heights, Alone::kDifference);
}

/// Whether the drawing may take at most `bytes` bytes. Shapes whose borders look like noise to the
/// estimate take two thirds of it.
inline bool drawingMayFit(const PlaneView<const int32_t>& heights, uint64_t bytes) {
  return estimateDrawing(heights) <= 1.5 * static_cast<double>(bytes);
}

// encodeDrawnHeights() codes heights in steps as a drawing, which decodeDrawnHeights() decodes.

/// Codes all heights without loss, whole. Nothing if there are more than kMostDrawnValues values.
/// Distortion is in squared units of the heights, summed over the valid samples.
std::optional<EncodedTrack> encodeDrawnHeights(const PlaneView<const int32_t>& heights);

// prefixesOfDrawing() gives the heights that each prefix of a drawing shows, for encoders that
// measure many prefixes. It decodes the drawing once.

/// Returns a function that gives the same heights as decodeDrawnHeights() of the first bytes of the
/// codeword at level 0, in less time. codeword: all of it, as an encoder wrote it. valid: of the
/// plane.
std::function<DecodedGeometry(uint64_t bytes)> prefixesOfDrawing(const GeometryHeader& header,
                                                                 std::span<const uint8_t> codeword,
                                                                 Mask valid);

}  // namespace tetrakis::inline drawn_heights
