// SPDX-License-Identifier: Apache-2.0
// PicturePoint is one point of a camera's picture: the ray behind it, the ground that the ray
// meets, and the colour of that ground. A ray finds the ground, so hidden ground counts nothing,
// near ground much, and a height error moves the texture as far as it does on the screen; the size
// of a pixel on the ground says which levels of the texture are seen.
#pragma once

#include <vector>

#include "base/plane.hpp"
#include "codec/ground/camera.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"
#include "ratecontrol/pictures/screen_texture.hpp"

namespace tetrakis::inline pictures {

/// Any place in a picture.
struct PicturePoint {
  Ray ray;
  Vec3 right{}, down{};  ///< change of the direction from pixel to pixel
  Colour sky{};          ///< colour of the point where no ground is
};

/// The points of a camera's picture.
class CameraPoints {
 public:
  explicit CameraPoints(const Camera& camera);

  /// column, row: in pixels from the upper left corner; a half in either is the centre of a pixel.
  PicturePoint at(double column, double row) const;

 private:
  Vec3 corner_{};  ///< direction of the upper left corner
  PicturePoint origin_;
  uint32_t height_;
};

/// The ground that a point shows.
struct SeenPoint {
  bool ground = false;  ///< else it shows the sky
  double u = 0, v = 0;  ///< place in the texture, from 0 to 1
  double level = 0;     ///< of detail, as renderers choose it for half a pixel
};

/// texture: its size in texels.
SeenPoint seenAt(const PicturePoint& point, const GroundRays& ground, Extent texture);

/// The colour of the point: a sample as wide as half a pixel.
Colour colourOf(const PicturePoint& point, const SeenPoint& seen, const ScreenTexture& texture);

/// Squared difference, the sum of R, G and B.
double squaresBetween(const Colour& a, const Colour& b);

/// The weights of cameras as parts of 1. At least one weight is positive.
std::vector<double> sharesOf(const std::vector<Camera>& cameras);

}  // namespace tetrakis::inline pictures
