// SPDX-License-Identifier: Apache-2.0
// Nodes are the prefixes of both components whose pairs an engine looks at.
#pragma once

#include <vector>

#include "bitstream/track/track_encoder.hpp"

namespace tetrakis::inline views {

/// Points of either curve, from the first to the last.
struct Nodes {
  std::vector<RatePoint> heights, textures;
};

}  // namespace tetrakis::inline views
