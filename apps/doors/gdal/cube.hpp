// SPDX-License-Identifier: Apache-2.0
// The globe on a cube: which streams hold one, and how heights of a copy go there. It follows the
// command line (apps/tools/files/cube_heights.hpp).
#pragma once

#include <cstdint>
#include <string>

#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

struct CopiedHeights;

/// Whether the heights of a stream lie on a cube and were made of a grid.
bool isGridOnCube(const tks_info& info);

struct CubeWanted {
  uint32_t depth;  ///< 0: that of tks_cube_depth
  uint32_t threads;
  double degrees;  ///< in the unit of the grid's CRS; 0: it has no angles
};

/// Takes heights of a grid to a cube, as samples of the same type. False after a reported error.
bool resampleOnCube(const std::string& name, const CubeWanted& wanted, CopiedHeights& copy);

}  // namespace tetrakis::gdal
