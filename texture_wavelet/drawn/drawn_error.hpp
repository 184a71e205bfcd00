// SPDX-License-Identifier: Apache-2.0
// DrawnError measures the squared error of an image of which only some texels are decoded, again
// and again while their number grows. Encoder only.
#pragma once

#include <span>
#include <vector>

#include "base/texels.hpp"
#include "codec/drawing/drawing_index.hpp"
#include "codec/lattice/levels.hpp"

namespace tetrakis::inline drawn {

/// Measures an image again and again while more of it becomes known.
class DrawnError {
 public:
  /// Both outlive this. levels: those of the grid, coarse to fine.
  DrawnError(const Texels& original, std::span<const Level> levels)
      : original_(original), levels_(levels), shown_(original) {}

  /// The squared error of all samples when texels with an index show what they are, and fillDrawn()
  /// gives the others their colours.
  double squares(std::span<const KeptIndex> indices);

 private:
  const Texels& original_;
  std::span<const Level> levels_;
  Texels shown_;
};

}  // namespace tetrakis::inline drawn
