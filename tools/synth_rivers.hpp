// SPDX-License-Identifier: Apache-2.0
// Rivers as smooth bands of natural width.
#pragma once

#include "tools/synth_relief.hpp"

namespace tetrakis::tools::synth {

/// Farther than this from any bank, distances are cut off. Metres.
inline constexpr double kRiverReach = 120;

/// Metres from the middle of each texel to the nearest river bank, negative in the water, at most
/// kRiverReach. The texels, two a sample, lie over the terrain without its margin.
Grid riverDistance(const Relief& relief, uint32_t texels);

}  // namespace tetrakis::tools::synth
