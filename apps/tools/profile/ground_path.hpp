// SPDX-License-Identifier: Apache-2.0
// parseLine() reads a line over a height field as a user types it, and pathOver() places it on the
// grid.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/tools/files/stream.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// A place, in the coordinates that a line is given in.
struct LinePoint {
  double x = 0, y = 0;
};

/// "X,Y X,Y …": two places or more, of which two differ. TKS_USAGE.
Result<std::vector<LinePoint>> parseLine(const std::string& text);

/// A line over a grid. Column c and row r, (0, 0) the middle of the first sample, lie at
/// x = [0] + c [1] + r [2], y = [3] + c [4] + r [5].
struct GroundPath {
  std::vector<LinePoint> points;
  GeoTransform place = {0, 1, 0, 0, 0, 1};  ///< as it stands: columns and rows
  std::array<double, 2> spacing = {1, 1};   ///< what a column and a row count in distances
  bool metres = false;                      ///< distances are metres, else samples
};

/// The path with all that the stream tells. geographic: the points are in the coordinates of its
/// geotransform. TKS_USAGE if it has none, or none that can be inverted.
Result<GroundPath> pathOver(const tks_info& info, std::vector<LinePoint> points, bool geographic);

}  // namespace tetrakis::tools
