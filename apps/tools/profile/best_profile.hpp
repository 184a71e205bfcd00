// SPDX-License-Identifier: Apache-2.0
// bestProfile() finds the best polyline of few points through the ground under a line
// (codec/polyline/).
#pragma once

#include <cstdint>
#include <vector>

#include "apps/tools/profile/ground_line.hpp"

namespace tetrakis::tools {

struct BestProfile {
  std::vector<std::vector<uint32_t>> points;  ///< of each piece: which of its samples, ascending
  const char* algorithm = "";                 ///< "uoptimal" or "udecimate-global"
  double rmse = 0;                            ///< over all samples of the line
};

/// Both ends of each piece.
size_t fewestPoints(const GroundLine& line);

/// At most so many points, and at least fewestPoints(): those of least squared error, over all
/// pieces together, and no more of them than that error needs. The optimum (uoptimal) wherever it
/// takes a second; longer lines are decimated by global error.
BestProfile bestProfile(const GroundLine& line, size_t points);

}  // namespace tetrakis::tools
