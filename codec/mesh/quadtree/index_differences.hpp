// SPDX-License-Identifier: Apache-2.0
// IndexDifferences gives the difference between the location codes of two neighbours in closed
// form, so that a traversal goes on by one addition (thesis 4.4, theorem 4.1).
//
// Neighbours whose lowest common ancestor is r + 1 levels up differ by a constant. Between columns
// g - 1 and g of a level that r, the relative level distance (4.6), is the number of zeros that g
// ends with; so one short table replaces the delta-vectors of 2^i + 1 entries (4.7). Where g is a
// multiple of 2^i the step leaves the patch: it is the toroidal difference (4.2), (4.4), plus the
// distance to the patch that it enters, times 4^i.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "codec/mesh/quadtree/location_code.hpp"

namespace tetrakis::inline quadtree {

constexpr int64_t powerOfFour(uint32_t exponent) {
  return int64_t{1} << 2 * exponent;
}
/// (4.1): between horizontal neighbours at relative level distance r. Vertical differences are
/// twice as large: (4.3), (4.4).
constexpr int64_t horizontalDifference(uint32_t r) {
  return (2 * powerOfFour(r) + 1) / 3;
}
/// (4.2): between the ends of a row of the 2^level nodes that a patch has there.
constexpr int64_t toroidalHorizontalDifference(uint32_t level) {
  return (powerOfFour(level) - 1) / 3;
}

/// All differences of a forest. Additions are modulo 2^32, so that steps back need no sign.
class IndexDifferences {
 public:
  explicit IndexDifferences(QuadtreeShape shape) : shape_(shape) {
    for (uint32_t level = 0; level < kLevels; ++level) {
      const int64_t patch = powerOfFour(level), torus = toroidalHorizontalDifference(level);
      within_[level] = static_cast<uint32_t>(horizontalDifference(level));
      Border& border = borders_[level];
      border.enter_east = static_cast<uint32_t>(patch - torus);
      border.wrap_east = static_cast<uint32_t>(-torus - (shape.columns - 1) * patch);
      border.enter_south = static_cast<uint32_t>(shape.columns * patch - 2 * torus);
      border.wrap_south =
          static_cast<uint32_t>(-2 * torus - int64_t{shape.rows - 1} * shape.columns * patch);
    }
  }

  const QuadtreeShape& shape() const { return shape_; }

  /// What a step east from column g - 1 to column g adds. g = 0 and g = columns of the level: from
  /// the last column to the first.
  uint32_t horizontal(uint32_t level, uint32_t g) const {
    const auto r = static_cast<uint32_t>(std::countr_zero(g | 1u << level));
    if (r < level) return within_[r];
    const bool wraps = g == 0 || g == shape_.columnsOf(level);
    return wraps ? borders_[level].wrap_east : borders_[level].enter_east;
  }
  /// The difference of a step south, from row g - 1 to row g.
  uint32_t vertical(uint32_t level, uint32_t g) const {
    const auto r = static_cast<uint32_t>(std::countr_zero(g | 1u << level));
    if (r < level) return 2 * within_[r];
    const bool wraps = g == 0 || g == shape_.rowsOf(level);
    return wraps ? borders_[level].wrap_south : borders_[level].enter_south;
  }

 private:
  static constexpr uint32_t kLevels = 16;
  struct Border {
    uint32_t enter_east = 0, wrap_east = 0, enter_south = 0, wrap_south = 0;
  };

  QuadtreeShape shape_;
  std::array<uint32_t, kLevels> within_{};
  std::array<Border, kLevels> borders_{};
};

}  // namespace tetrakis::inline quadtree
