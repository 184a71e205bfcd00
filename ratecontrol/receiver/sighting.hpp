// SPDX-License-Identifier: Apache-2.0
// A Sighting tells how the picture of a viewer, now or later, shows each point of the ground, so
// that a receiver can say which bytes improve it.
#pragma once

#include <cstdint>
#include <vector>

#include "ratecontrol/receiver/ground_sight.hpp"

namespace tetrakis::inline receiver {

/// What a receiver looks at. Without points all ground counts alike.
struct Sighting {
  uint32_t columns = 0, rows = 0;  ///< of the points, which lie over all of the ground
  std::vector<GroundPoint> points;
  uint32_t triangles = 0;  ///< that meshes will have; 0: any number
};

/// What some viewer sees, and how much that counts.
struct WeightedSighting {
  Sighting sighting;
  double weight = 1;
};

}  // namespace tetrakis::inline receiver
