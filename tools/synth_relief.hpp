// SPDX-License-Identifier: Apache-2.0
// The shape of the sample terrain.
#pragma once

#include <cstdint>

#include "tools/synth_drainage.hpp"
#include "tools/synth_grid.hpp"

namespace tetrakis::tools::synth {

inline constexpr double kSpacing = 30;      ///< metres between samples
inline constexpr double kHeightStep = 0.1;  ///< metres of one unit of a sample

enum class Cover : uint8_t { kLand, kSea, kLake };

/// Rasters reach `margin` samples beyond the terrain on each side, so that nothing shows its
/// border.
struct Relief {
  uint32_t margin = 0;
  Grid height;  ///< metres, whole multiples of kHeightStep; the sea is 0
  Raster<Cover> cover;
  Drainage drainage;  ///< of `height`, into the sea
};

Relief makeRelief(uint32_t size, uint64_t seed);

}  // namespace tetrakis::tools::synth
