// SPDX-License-Identifier: Apache-2.0
// The globe on a cube: a forest of six patches, the equiangular projection of a cube's faces onto
// the unit sphere (C. Ronchi, R. Iacono, P. S. Paolucci, "The cubed sphere", 1996). Patches 0 to 3
// go eastwards round the equator, with longitudes 0, 90, 180 and -90 in their middles; patch 4 has
// the north pole in its middle, patch 5 the south pole.
//
// Longitude and geodetic latitude are taken for spherical coordinates: what is projected is that
// sphere of parameters, and not an ellipsoid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/forest.hpp"

namespace tetrakis::inline cube {

inline constexpr uint32_t kCubePatches = 6;

/// What the sides of the patches are glued to. Six of the twelve pairs are a north and a south, or
/// an east and a west: more is not possible.
inline constexpr std::array<uint32_t, kCubePatches* Forest::kSides> kCubeSides = {
    18, 7,  20, 13,  // from longitude -45 to 45
    17, 11, 21, 1,   // from 45 to 135
    16, 15, 22, 5,   // from 135 to -135
    19, 3,  23, 9,   // from -135 to -45
    8,  4,  0,  12,  // round the north pole
    2,  6,  10, 14,  // round the south pole
};

Forest cubeForest(int depth);

/// A point of the unit sphere: x at longitude 0, y at 90, z north.
struct SpherePoint {
  double x, y, z;
};

/// A place on a patch: 0 to 1 from west to east, and from north to south.
struct CubePlace {
  uint32_t patch;
  double x, y;
};

/// A place on the Earth, in degrees.
struct Geographic {
  double longitude, latitude;
};

/// How far off the middle of a face, whose half side is 1, the ray through x (or y) of its patch
/// is: 0 to 1, or somewhat beyond. Rays are at equal angles.
double offMiddle(double x);
/// The inverse, of -1 to 1.
double placeAt(double off_middle);
/// What samples of a patch cover of the sphere, row by row, the one in the middle 1: angles in x
/// and y are equal, so that areas are the determinant of their directions.
std::vector<float> patchAreas(uint32_t side);

/// The point of the sphere on the ray through a point of a face, by offMiddle() of x and of y.
SpherePoint pointOf(uint32_t patch, double off_x, double off_y);

/// Of points on a side, the first patch.
CubePlace cubePlaceOf(const SpherePoint& point);

/// Any longitude.
SpherePoint pointOf(const Geographic& place);
/// Longitudes from -180 to 180.
Geographic geographicOf(const SpherePoint& point);

/// Of any angle in degrees. Multiples of 90 have exact ones.
double sineOfDegrees(double degrees);
double cosineOfDegrees(double degrees);

}  // namespace tetrakis::inline cube
