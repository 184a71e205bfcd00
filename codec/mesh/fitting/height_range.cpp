// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/fitting/height_range.hpp"

#include <algorithm>
#include <limits>

namespace tetrakis::inline fitting {

std::vector<double> withinRange(const WeightedSurface& surface, std::vector<double> heights) {
  int32_t low = std::numeric_limits<int32_t>::max(), high = std::numeric_limits<int32_t>::min();
  for (size_t i = 0; i < surface.view.heights.size(); ++i) {
    if (!surface.isKnown(i)) continue;
    low = std::min(low, surface.view.heights[i]);
    high = std::max(high, surface.view.heights[i]);
  }
  if (low > high) return heights;
  for (double& height : heights) height = std::clamp<double>(height, low, high);
  return heights;
}

}  // namespace tetrakis::inline fitting
