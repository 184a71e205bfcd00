// SPDX-License-Identifier: Apache-2.0
// PictureErrors measures how far the cameras' pictures of other surfaces and textures are from
// those of the true terrain: inside the ground by points (screen_points.hpp), at its end before the
// sky by columns (outlines.hpp). The error of a picture is the sum of both.
#pragma once

#include <cstddef>
#include <vector>

#include "base/texels.hpp"
#include "codec/ground/camera.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"
#include "ratecontrol/pictures/outlines.hpp"
#include "ratecontrol/pictures/screen_points.hpp"
#include "ratecontrol/pictures/screen_texture.hpp"

namespace tetrakis::inline pictures {

class PictureErrors {
 public:
  /// pixels: the number of pixels that are looked at, of all pictures together. At least one camera
  /// has a weight.
  PictureErrors(const std::vector<Camera>& cameras, size_t pixels, const GroundRays& ground,
                const Texels& texels);

  /// A surface as the cameras see it.
  struct Surface {
    std::vector<SeenPoint> seen;
    double outlines = 0;  ///< their error
  };
  Surface surfaceOf(const GroundRays& ground) const;

  const Surface& trueSurface() const { return true_surface_; }
  const ScreenTexture& trueTexture() const { return true_texture_; }

  /// The error of the pictures inside the ground, of a surface with a texture.
  double errorInside(const Surface& surface, const ScreenTexture& texture) const;

 private:
  Extent texels_;
  ScreenTexture true_texture_;
  ScreenPoints points_;
  Outlines outlines_;
  Surface true_surface_;
  std::vector<Colour> true_colours_;
};

}  // namespace tetrakis::inline pictures
