// SPDX-License-Identifier: Apache-2.0
// shownHeights() turns heights of the coded lines into those of a view of all lines
// (codec/lines/shown_lines.hpp).
#pragma once

#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/lines/shown_lines.hpp"

namespace tetrakis::inline geometry {

/// Turns heights of coded lines into those of the view. Where a coded sample is shown several
/// times, the vertex lies at its first place.
DecodedHeights shownHeights(const ShownLines& lines, DecodedHeights decoded);

}  // namespace tetrakis::inline geometry
