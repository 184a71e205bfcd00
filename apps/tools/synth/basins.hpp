// SPDX-License-Identifier: Apache-2.0
// waterLevel() computes how high water stands at each place of a raster of heights.
#pragma once

#include <cstdint>

#include "apps/tools/synth/grid.hpp"

namespace tetrakis::tools::synth {

/// The lowest highest point of all paths from each cell to an outlet: its height, or the water
/// level of its depression. Outlets (!= 0, one at least) keep their heights.
Grid waterLevel(const Grid& height, const Raster<uint8_t>& outlet);

}  // namespace tetrakis::tools::synth
