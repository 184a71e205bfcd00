// SPDX-License-Identifier: Apache-2.0
// followedBy() appends corrections to coded heights: at the end of the first track or, of heights
// in regions, as a track for each region (bitstream/stream/correction_tracks.hpp), so that a window
// needs no corrections of other regions. These tracks come last in the stream, because a correction
// means nothing for another height than the one it was made for.
#pragma once

#include "codec/geometry/corrections/correction_parts.hpp"
#include "encoder/heights/coded_heights.hpp"

namespace tetrakis::inline heights {

/// Appends corrections to heights. heights: without corrections. layers: those of the heights, with
/// what the header says of corrections. corrections: the codeword of each part of the plane.
/// corrected_to: the squared error, in steps, that the corrections leave.
CodedHeights followedBy(CodedHeights heights, GeometryLayers layers,
                        const PartCodewords& corrections, double corrected_to);

/// The same with corrections that restore every sample. left: the least squared error, in steps,
/// that coefficients alone leave, above 0: steps that seem exact may lack the last bits.
CodedHeights restoredBy(CodedHeights heights, GeometryLayers layers,
                        const PartCodewords& corrections, double left);

}  // namespace tetrakis::inline heights
