// SPDX-License-Identifier: Apache-2.0
// shownHeights() turns heights of the coded lines into those of a view of all lines
// (codec/lines/shown_lines.hpp).
#pragma once

#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/lines/shown_lines.hpp"

namespace tetrakis::inline geometry {

/// Makes heights of coded lines those of the view. A vertex is that of a coded sample where that is
/// shown first.
DecodedHeights shownHeights(const ShownLines& lines, DecodedHeights decoded);

}  // namespace tetrakis::inline geometry
