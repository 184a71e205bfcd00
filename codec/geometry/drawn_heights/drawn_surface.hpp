// SPDX-License-Identifier: Apache-2.0
// DrawnSurface gives every vertex of drawn heights a height: its step where that is known, else the
// mean of the coarser vertices beside it. Vertices that differ from that mean count as significant,
// so that coded meshes have vertices only at edges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/plane.hpp"
#include "codec/geometry/drawn_heights/drawn_steps.hpp"
#include "codec/lattice/levels.hpp"

namespace tetrakis::inline drawn_heights {

/// The surface of heights of which some vertices have the index of a step.
struct DrawnSurface {
  std::span<const KeptIndex> indices;  ///< of each sample of the grid
  Extent extent;                       ///< of the grid
  const BitPlane* valid;               ///< null: all samples are
  const DrawnSteps& steps;
  std::span<const Level> levels;  ///< those of the grid, coarse to fine
  Window shown;                   ///< the part that is wanted

  /// Heights are in units of 2^-kFractionBits steps.
  static constexpr int kFractionBits = 4;

  bool isWhole() const { return shown.extent() == extent; }

  /// Writes the heights of the part, and the heights that they depend on, at their places in a grid
  /// of heights. A vertex without an index becomes the mean of the coarser vertices next to it: of
  /// the valid ones, or of all if none is valid. A root is 0. Voids get heights in the same way.
  void fill(int32_t* heights) const;

  /// Marks of the part: 1 where a step differs from the height that its vertex would have without
  /// it.
  std::vector<uint8_t> significant(const int32_t* heights) const;
};

}  // namespace tetrakis::inline drawn_heights
