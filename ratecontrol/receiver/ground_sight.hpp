// SPDX-License-Identifier: Apache-2.0
// sightOf() tells from coarse heights the cost of an error of the ground at each point in one
// picture (thesis 6.1): how many pixels show the ground around the point, and how far a height
// error moves it on the screen. Both come from derivatives of the camera's matrix, which knows
// neither metres nor angles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace tetrakis::inline receiver {

/// Heights at every `step`-th column and row of a grid, none of them NaN, in the matrix's unit.
struct CoarseGround {
  uint32_t columns = 0, rows = 0, step = 1;
  std::vector<float> heights;
};

/// Takes (column, row, height, 1) to clip coordinates, as tks_screen_camera.
struct Eye {
  std::array<double, 16> clip{};
  uint32_t width = 0, height = 0;  ///< of the picture, in pixels
};

/// What a point of the ground is to a picture.
struct GroundPoint {
  double pixels = 0;    ///< that one sample of the grid covers; 0: hidden, or outside
  double parallax = 0;  ///< squared pixels that a height error of 1 moves the point by
};

/// One a point of the ground, row by row. A point is hidden where a straight walk to the eye goes
/// below coarse ground. Without such an eye (a map) nothing is hidden.
std::vector<GroundPoint> sightOf(const CoarseGround& ground, const Eye& eye);

/// What a viewer sees who turns on the spot to face each point: what a picture would show whose
/// middle column looked that way. aspect: the spacing of columns over that of rows. Nothing
/// is seen without an eye.
std::vector<GroundPoint> sightAround(const CoarseGround& ground, const Eye& eye, double aspect);

}  // namespace tetrakis::inline receiver
