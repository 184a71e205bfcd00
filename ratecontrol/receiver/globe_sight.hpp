// SPDX-License-Identifier: Apache-2.0
// sightOf() tells of a globe what ground_sight.hpp tells of flat ground: for each point the pixels
// that show it and its parallax, from derivatives of its place on the globe. What faces away from
// the viewer is behind the horizon; mountains hide nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "ratecontrol/receiver/eye.hpp"
#include "ratecontrol/receiver/ground_sight.hpp"

namespace tetrakis::inline receiver {

/// A sample of the ground, in metres from the centre of the globe.
struct GlobePoint {
  Vec3 at;
  Vec3 column, row;  ///< ways to the next column and to the next row
  Vec3 up;           ///< the way that a height of 1 lifts it
};

/// Points that lie over all of a raster, row by row.
struct GlobeGround {
  uint32_t columns = 0, rows = 0;
  std::vector<GlobePoint> points;
};

/// Of a parallel projection, which has no eye, nothing is hidden.
SeenRaster sightOf(const GlobeGround& ground, const Eye& eye);

/// What a viewer sees who turns the globe: each point as the points that are seen are in the mean
/// of their area. seen: of that ground.
SeenRaster sightAround(const GlobeGround& ground, const SeenRaster& seen);

}  // namespace tetrakis::inline receiver
