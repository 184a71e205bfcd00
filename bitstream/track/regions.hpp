// SPDX-License-Identifier: Apache-2.0
// A Region is the part of a plane's coefficients that one track holds (docs/FORMAT.md, section
// 5.1), so that a window of the plane can be decoded alone. The transform knows nothing of regions.
//
// Every coefficient belongs to a sample of the plane. The finest kRegionLevels levels are split
// into regions of side 2^s, the next kRegionLevels into regions of side 2^(s + kRegionLevels), and
// so on, each of about as many coefficients as a region of the finest levels. Where one region
// would be left it is the base, which holds all the coarser levels as well.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "base/view.hpp"

namespace tetrakis::inline track {

inline constexpr int kRegionLevels = 3;
inline constexpr int kLeastRegionLog2 = 4;  ///< smallest side 2^s; above kRegionLevels
inline constexpr int kMostRegionLog2 = 20;

/// What one track holds: the coefficients of some levels whose samples lie in a rectangle.
struct Region {
  static constexpr int kAll = std::numeric_limits<int>::max();

  int first_level = 1, last_level = kAll;   ///< kAll: down to LL, which is the base's
  uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< samples; x1 and y1 lie behind the last

  bool isBase() const { return last_level == kAll; }
  bool holds(int level) const { return level >= first_level && level <= last_level; }
};

/// The tracks of a plane in the order of their numbers: the base, then the regions from the
/// coarsest levels to the finest, row by row. side_log2 0: the base alone, with everything.
std::vector<Region> regionsOf(uint32_t width, uint32_t height, int side_log2);

/// The regions of the finest levels, row by row, each as a rectangle of the plane; none if the base
/// holds everything.
std::vector<Window> finestRegions(uint32_t width, uint32_t height, int side_log2);

/// For each group of levels a region that no other of the group is larger than, in rows or columns.
std::vector<Region> largestRegions(uint32_t width, uint32_t height, int side_log2);

/// How many regionsOf() are.
uint64_t regionCount(uint32_t width, uint32_t height, int side_log2);

/// How many finestRegions() are.
uint64_t finestRegionCount(uint32_t width, uint32_t height, int side_log2);

}  // namespace tetrakis::inline track
