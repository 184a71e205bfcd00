// SPDX-License-Identifier: Apache-2.0
// A PicturePoint is a place in a camera's picture; seenAt() returns the ground that it shows, and
// colourOf() the colour of that ground in a ScreenTexture, as a renderer would filter it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "base/samples.hpp"
#include "codec/ground/camera.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"

namespace tetrakis::inline pictures {

// ScreenTexture is a texture as renderers show it: a pyramid of levels, each half the size of the
// one before, and trilinear filters between their texels.

using Colour = std::array<float, 3>;  ///< of 0 to 255

/// R, G and B in 16 bits each, from the lowest up: one multiplication weighs all three.
using Lanes = uint64_t;

/// The texels as they are shown, in 8 bits: grey becomes three equal colours; alpha darkens them.
std::vector<Lanes> shownTexels(const Texels& texels);

class ScreenTexture {
 public:
  /// texels: the whole image, or its samples at multiples of 2^level in x and y (base/view.hpp),
  /// which hold what coarser levels of the image show.
  ScreenTexture(const Texels& texels, Extent whole, int level = 0);

  /// u, v: from 0 to 1 over the image; clamped. level: of detail, 0 the finest resolution.
  Colour at(double u, double v, double level) const;

 private:
  struct Level {
    uint32_t width = 0, height = 0;
    std::vector<Lanes> texels;
    /// Place of a level's texel = scale * (place from 0 to 1) - shift.
    double scale_x = 1, scale_y = 1, shift = 0;
  };
  static Level halved(const Level& fine);
  void place(Level& level, int halvings) const;
  static void addBilinear(const Level& level, double u, double v, float weight, Colour& sum);

  Extent whole_;
  int first_;                  ///< level of detail of levels_[0]
  std::vector<Level> levels_;  ///< each half as wide as the one before
};

// PicturePoint is one point of a camera's picture: the ray behind it, the ground that the ray
// meets, and the colour of that ground. A ray finds the ground, so hidden ground counts nothing,
// near ground much, and a height error moves the texture as far as it does on the screen; the size
// of a pixel on the ground says which levels of the texture are seen.

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
