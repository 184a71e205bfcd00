// SPDX-License-Identifier: Apache-2.0
// GroundFrame says where the samples of a grid of heights lie in space, in metres. The rule for
// grids that do not say how far apart their samples are is in knownFrame() alone: encoders, cameras
// and meshes must see the same ground.
#pragma once

#include <array>
#include <cstdint>

#include "base/length_unit.hpp"

namespace tetrakis::inline ground {

/// Column c, row r and height h, in the unit of the heights, are at
/// ((c - (width - 1) / 2) * spacing_x,
///  h * metres_per_unit,
///  (r - (height - 1) / 2) * spacing_y): x east, y up, z south.
struct GroundFrame {
  uint32_t width = 0, height = 0;
  double spacing_x = 1, spacing_y = 1;  ///< metres
  double metres_per_unit = 1;
};

/// The frame of a grid of which 0 metres per sample are known: that of the other direction, or
/// kUnknownSpacing.
inline GroundFrame knownFrame(GroundFrame frame) {
  const bool x = frame.spacing_x > 0, y = frame.spacing_y > 0;
  if (!x) frame.spacing_x = y ? frame.spacing_y : kUnknownSpacing;
  if (!y) frame.spacing_y = frame.spacing_x;
  return frame;
}

/// Axis-aligned bounds of a terrain.
struct Bounds {
  std::array<double, 3> low{}, high{};
};

}  // namespace tetrakis::inline ground
