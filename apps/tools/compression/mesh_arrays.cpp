// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/compression/mesh_arrays.hpp"

#include <algorithm>

namespace tetrakis::tools {

MeshBounds meshBounds(std::span<const float> positions) {
  MeshBounds bounds;
  for (size_t axis = 0; axis < 3; ++axis) {
    float low = positions[axis], high = low;
    for (size_t i = axis; i < positions.size(); i += 3) {
      low = std::min(low, positions[i]);
      high = std::max(high, positions[i]);
    }
    bounds.low[axis] = low;
    bounds.high[axis] = high;
  }
  return bounds;
}

PositionSteps positionSteps(const MeshBounds& bounds) {
  constexpr double kSteps = 65535, kHeightSteps = 16383, kFinest = 16;
  const auto extent = [&](size_t axis) { return double{bounds.high[axis]} - bounds.low[axis]; };
  const double horizontal = std::max(extent(0), extent(2)) / kSteps;
  return {horizontal, std::max(extent(1) / kHeightSteps, extent(1) > 0 ? horizontal / kFinest : 0)};
}

}  // namespace tetrakis::tools
