// SPDX-License-Identifier: Apache-2.0
// Gives every vertex of drawn heights a height, whether its step is known or not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "codec/geometry/drawn_heights/drawn_steps.hpp"
#include "lattice/levels.hpp"

namespace tetrakis::inline drawn_heights {

/// The surface of heights of which some vertices have the index of a step.
struct DrawnSurface {
  PlaneView<const DrawnIndex> indices;  ///< with the mask of valid samples
  const DrawnSteps& steps;
  std::span<const Level> levels;  ///< those of the grid, coarse to fine

  /// heights() are in units of 2^-kFractionBits steps.
  static constexpr int kFractionBits = 4;

  /// A vertex without an index becomes the mean of the coarser vertices next to it: of those that
  /// are valid, or if none is, of all. A root is 0. Voids get such a height as well.
  std::vector<int32_t> heights() const;

  /// 1 where a step is another than the height that its vertex would have without one.
  std::vector<uint8_t> significant(const std::vector<int32_t>& heights) const;
};

}  // namespace tetrakis::inline drawn_heights
