// SPDX-License-Identifier: Apache-2.0
// A Leg is a straight part of a path, and says which part of it lies over the grid.
#pragma once

#include <cmath>
#include <vector>

#include "apps/tools/profile/ground_path.hpp"

namespace tetrakis::tools {

/// A place in columns and rows.
struct GridPoint {
  double column = 0, row = 0;
};

/// A leg goes straight from one point to another one, which differs. From the part `enters` of it
/// to the part `exits` it lies over the ground.
struct Leg {
  GridPoint from, to;
  LinePoint at_from, at_to;   ///< the same points as they were given
  double start = 0, end = 0;  ///< distances
  double enters = 0, exits = 0;

  bool meetsGround() const { return enters <= exits; }
  double samples() const { return std::hypot(to.column - from.column, to.row - from.row); }
  double distance(double part) const { return start + part * (end - start); }
  GridPoint pointAt(double part) const {
    return {from.column + part * (to.column - from.column), from.row + part * (to.row - from.row)};
  }
};

/// The legs between points that differ.
std::vector<Leg> legsOf(const GroundPath& path, const tks_info& info);

/// The samples that the legs need. Some leg meets the ground.
tks_window windowAround(const std::vector<Leg>& legs, const tks_info& info);

}  // namespace tetrakis::tools
