// SPDX-License-Identifier: Apache-2.0
// GroundAxes tells in which directions the rows and columns of a raster run on the ground. Most
// rasters begin in the north-west; others are south-up (their first row is the southern one),
// turned or sheared.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

/// Directions of length 1, each as its part to the east and its part to the south.
struct GroundAxes {
  std::array<double, 2> along{1, 0};  ///< a row, from its first sample on
  std::array<double, 2> down{0, 1};   ///< a column

  /// From metres along rows and down columns to metres east and south.
  std::array<double, 2> placed(double x, double z) const {
    return {x * along[0] + z * down[0], x * along[1] + z * down[1]};
  }
  /// The inverse of placed().
  std::array<double, 2> unplaced(double east, double south) const {
    return {(east * down[1] - south * down[0]) / area(),
            (south * along[0] - east * along[1]) / area()};
  }
  /// From slopes along rows and down columns, in metres a metre, to slopes east and south.
  std::array<double, 2> placedSlope(double x, double z) const {
    return {(x * down[1] - z * along[1]) / area(), (z * along[0] - x * down[0]) / area()};
  }
  /// Seen from above, columns run to the left of rows.
  bool mirrored() const { return area() < 0; }

 private:
  double area() const { return along[0] * down[1] - along[1] * down[0]; }
};

/// Those of a raster that begins in the north-west where the transform says nothing: it has no
/// inverse. Degrees are as long as at the middle of the raster; other coordinates count alike.
GroundAxes groundAxes(const GeoTransform& transform, uint32_t width, uint32_t height,
                      const std::string& crs);

/// How a raster is turned so that its first row is the northern one, and its first sample the
/// western one, or those that are nearest to that. Rows become columns first.
struct QuarterTurn {
  bool transposed, rows_back, columns_back;

  explicit QuarterTurn(const GroundAxes& axes);
  bool none() const { return !transposed && !rows_back && !columns_back; }
};

}  // namespace tetrakis::tools
