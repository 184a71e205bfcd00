// SPDX-License-Identifier: Apache-2.0
// groundUnder() samples the ground under a line over a height field: profiles are made of these
// samples.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/tools/files/stream.hpp"
#include "apps/tools/profile/ground_path.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

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
