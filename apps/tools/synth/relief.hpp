// SPDX-License-Identifier: Apache-2.0
// makeRelief() makes the heights and the cover of the sample terrain.
#pragma once

#include <cstdint>

#include "apps/tools/synth/drainage.hpp"
#include "apps/tools/synth/grid.hpp"

namespace tetrakis::tools::synth {

inline constexpr double kSpacing = 30;      ///< metres between samples
inline constexpr double kHeightStep = 0.1;  ///< metres of one unit of a sample

enum class Cover : uint8_t { kLand, kSea, kLake, kRoof };

/// Rasters reach `margin` samples beyond the terrain on each side, so that nothing shows its
/// border.
struct Relief {
  uint32_t margin = 0;
  Grid height;  ///< metres, of makeRelief whole multiples of kHeightStep; the sea is 0
  Raster<Cover> cover;
  Drainage drainage;  ///< of `height`, into the sea
  double spacing = kSpacing;
  double summit = 1;  ///< metres: what counts as high where nothing is higher
};

Relief makeRelief(uint32_t size, uint64_t seed);

/// Fills depressions, `lake_depth` metres deep ones with lakes, each at one level; puts the sea at
/// 0, the land above it, and drains it.
void settle(Relief& relief, const Raster<uint8_t>& sea, double lake_depth);

}  // namespace tetrakis::tools::synth
