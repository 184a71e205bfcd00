// SPDX-License-Identifier: Apache-2.0
// An Eye is a viewer's camera: pixelsBy() tells how its picture moves with a point of space.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/vec3.hpp"

namespace tetrakis::inline receiver {

/// Takes (place, 1) to clip coordinates, as tks_screen_camera. A place is (column, row, height), or
/// metres from the centre of a globe.
struct Eye {
  std::array<double, 16> clip{};
  uint32_t width = 0, height = 0;  ///< of the picture, in pixels
};

/// Where x, y and w of the clip coordinates are 0; nothing for parallel projections.
std::optional<Vec3> placeOf(const Eye& eye);

/// Pixels to the right and up, by each coordinate of a place.
struct PixelsBy {
  Vec3 right{}, up{};

  /// Those of a way from the place on.
  std::array<double, 2> along(const Vec3& way) const;
};

/// Nothing for what lies outside the picture.
std::optional<PixelsBy> pixelsBy(const Eye& eye, const Vec3& place);

/// What a point of the ground is to a picture.
struct GroundPoint {
  double pixels = 0;    ///< that one sample of the grid covers; 0: hidden, or outside
  double parallax = 0;  ///< squared pixels that a height error of 1 moves the point by
};

/// Of ways from a sample to the next column, to the next row, and up by 1. Nothing where a number
/// is not finite.
GroundPoint shownPoint(const std::array<double, 2>& column, const std::array<double, 2>& row,
                       const std::array<double, 2>& up);

}  // namespace tetrakis::inline receiver
