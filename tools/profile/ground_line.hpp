// SPDX-License-Identifier: Apache-2.0
// The ground under a line over a height field: what a profile is made of.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "tools/files/stream.hpp"

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

struct GroundSample {
  double distance = 0;  ///< along the line, from its first point
  double height = 0;    ///< in the unit of the heights
  LinePoint at;
};

/// A part of the line without heights, between the last sample before it and the first after it.
struct GroundGap {
  double from = 0, to = 0;
  bool outside = false;  ///< of the ground; else over voids
};

struct GroundLine {
  double length = 0;
  bool metres = false;                            ///< of the path
  std::vector<std::vector<GroundSample>> pieces;  ///< none is empty; gaps lie between them
  std::vector<GroundGap> gaps;
  size_t samples() const;
};

/// Decodes the ground under the line, no more of it than the window around the line, and takes
/// samples along each leg, at equal distances of at most one sample of the grid, both ends
/// included. Heights between samples are bilinear. TKS_USAGE if the line meets no ground.
Result<GroundLine> groundUnder(const GroundPath& path, Decoder& decoder);

}  // namespace tetrakis::tools
