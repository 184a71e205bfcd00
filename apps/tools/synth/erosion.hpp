// SPDX-License-Identifier: Apache-2.0
// erode() and slide() change a raster of heights as rivers and slopes do.
#pragma once

#include "apps/tools/synth/drainage.hpp"

namespace tetrakis::tools::synth {

/// Stream-power law dh/dt = uplift - K sqrt(area) slope, one implicit step per round over the
/// drainage tree (Braun and Willett, "A very efficient O(n), implicit and parallel method",
/// Geomorphology 180-181, 2013). Depressions are filled the same way. Cells of `fixed` != 0 are the
/// outlets. No uplift: the land does not rise.
struct StreamPower {
  int rounds = 1;
  double erodibility = 0.3;  ///< K dt of one round
  double creep = 0.05;       ///< share by which a cell moves to the mean of its neighbours a round
};
void erode(Grid& height, const Grid* uplift, const Raster<uint8_t>& fixed,
           const StreamPower& power);

/// Lets debris slide until no cell stands more than `drop` above a side neighbour, nearly: a fixed
/// number of rounds.
void slide(Grid& height, const Raster<uint8_t>& fixed, double drop, int rounds);

}  // namespace tetrakis::tools::synth
