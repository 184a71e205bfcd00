// SPDX-License-Identifier: Apache-2.0
// Outlines measures the error of pictures where the ground ends before the sky. Errors there are
// large and lie at few pixels, which points spread over a picture hardly meet. So some hundred
// columns of the pictures say where they meet the outlines of the true ground, and how far the
// outlines of another surface have moved. An outline that moves by some pixels shows ground instead
// of sky, or sky instead of ground.
#pragma once

#include <cstddef>
#include <vector>

#include "base/plane.hpp"
#include "codec/ground/camera.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"
#include "ratecontrol/pictures/picture_point.hpp"
#include "ratecontrol/pictures/screen_texture.hpp"

namespace tetrakis::inline pictures {

class Outlines {
 public:
  /// columns: over all cameras, shared by their weights, of which at least one is positive.
  /// texture: of the true ground. texels: its size.
  Outlines(const std::vector<Camera>& cameras, size_t columns, const GroundRays& truth,
           const ScreenTexture& texture, Extent texels);

  /// Squared error of a sample of R, G or B, spread over the pixels that show the true ground; the
  /// mean over the cameras that see any ground, by their weights. 0 if none does.
  ///
  /// Pixels smooth a shift s of less than a pixel: an edge then errs by s^2 - s^3 / 3 pixels, and
  /// by s - 1 / 3 beyond. But pixels are means of 2 x 2 samples, one of which makes a sixteenth, so
  /// an edge errs by s / 4 at least.
  double errorOf(const GroundRays& surface) const;

 private:
  /// A place in a column where ground and sky meet.
  struct Crossing {
    double column, row;
    double from, to;    ///< rows between which it may move: half the way to the next crossings
    bool ground_below;  ///< else the sky is
    double contrast;    ///< squared difference of a sample between both
  };
  struct View {
    CameraPoints points;
    double height;       ///< of the picture
    double weight = 0;   ///< of 1
    double covered = 0;  ///< pixels of the columns that show ground
    std::vector<Crossing> crossings = {};
  };

  /// Finds the crossings of ground and sky in a column, from its first row to the last.
  static void follow(View& view, double column, const GroundRays& truth,
                     const ScreenTexture& texture, Extent texels);
  /// Pixels by which the outline of another surface has moved at a crossing.
  static double shiftOf(const View& view, const Crossing& crossing, const GroundRays& surface);

  std::vector<View> views_;  ///< those that see ground
};

}  // namespace tetrakis::inline pictures
