// SPDX-License-Identifier: Apache-2.0
// sightOf() takes coarse heights and the eye of a viewer and returns for each point of the ground
// the cost of an error there in the viewer's picture; a Sighting is that cost with its ground.
#pragma once

#include <cstdint>
#include <vector>

#include "ratecontrol/receiver/eye.hpp"

namespace tetrakis::inline receiver {

// sightOf() tells from coarse heights the cost of an error of the ground at each point in one
// picture (thesis 6.1): how many pixels show the ground around the point, and how far a height
// error moves it on the screen. Both come from derivatives of the camera's matrix, which knows
// neither metres nor angles.

/// Heights at every `step`-th column and row of a grid, none of them NaN, in the matrix's unit.
struct CoarseGround {
  uint32_t columns = 0, rows = 0, step = 1;
  std::vector<float> heights;
};

/// One a point of the ground, row by row. A point is hidden where a straight walk to the eye goes
/// below coarse ground. Without such an eye (a map) nothing is hidden.
std::vector<GroundPoint> sightOf(const CoarseGround& ground, const Eye& eye);

/// What a viewer sees who turns on the spot to face each point: what a picture would show whose
/// middle column looked that way. aspect: the spacing of columns over that of rows. Nothing
/// is seen without an eye.
std::vector<GroundPoint> sightAround(const CoarseGround& ground, const Eye& eye, double aspect);

// A Sighting tells how the picture of a viewer, now or later, shows each point of the ground, so
// that a receiver can say which bytes improve it.

/// Points that lie over all of a raster, row by row.
struct SeenRaster {
  uint32_t columns = 0, rows = 0;
  std::vector<GroundPoint> points;
};

/// What a receiver looks at. Without points all ground counts alike.
struct Sighting {
  SeenRaster ground;        ///< over the heights, or over a texture without heights
  SeenRaster texture = {};  ///< over a texture that lies otherwise; without points: as the ground
  uint32_t triangles = 0;   ///< that meshes will have; 0: any number
};

/// What some viewer sees, and how much that counts.
struct WeightedSighting {
  Sighting sighting;
  double weight = 1;
};

}  // namespace tetrakis::inline receiver
