// SPDX-License-Identifier: Apache-2.0
// estimateDrawing() foretells how many bytes a drawing of heights takes, at a small part of the
// time of drawing them.
#pragma once

#include <cstdint>

#include "base/plane.hpp"
#include "codec/drawing/drawing_estimate.hpp"

namespace tetrakis::inline drawn_heights {

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

}  // namespace tetrakis::inline drawn_heights
