// SPDX-License-Identifier: Apache-2.0
// ScreenPoints is the modelled engine of screen distortion (thesis 6.1 and 6.2): it looks at a
// terrain at some thousand pixels of the cameras' pictures. Averages over these pixels are the
// squared errors that a renderer would find, to some percent. The same pixels serve all surfaces
// and textures, so that the difference of two errors is known much better.
//
// A pixel is the mean of four samples, whose errors d1 ... d4 partly cancel: half or less of fine
// errors remains. Two of the four samples tell how much, as long as all six pairs take turns. The
// squared error of the mean is
//   |d1 + d2 + d3 + d4|^2 / 16 = (the sum of |di|^2 + twice that of the six di.dj) / 16,
// which (|d|^2 + |e|^2) / 8 + 3/4 d.e has for its mean over the six pairs of errors d and e.
#pragma once

#include <cstddef>
#include <vector>

#include "base/plane.hpp"
#include "codec/ground/camera.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"
#include "ratecontrol/pictures/picture_point.hpp"
#include "ratecontrol/pictures/screen_texture.hpp"

namespace tetrakis::inline pictures {

class ScreenPoints {
 public:
  /// count: the pixels of all cameras, shared by their weights. At least one weight is positive.
  ScreenPoints(const std::vector<Camera>& cameras, size_t count);

  /// The ground that the two samples of each pixel show, one behind the other. texture: its size in
  /// texels.
  std::vector<SeenPoint> seenOf(const GroundRays& ground, Extent texture) const;

  /// The colour of each point.
  std::vector<Colour> coloursOf(const std::vector<SeenPoint>& seen,
                                const ScreenTexture& texture) const;

  /// One picture of every camera.
  struct Pictures {
    const std::vector<SeenPoint>& seen;
    const std::vector<Colour>& colours;
  };

  /// Squared error of a sample of R, G or B where both pictures show ground, over the points that
  /// either covers; the mean over the cameras that see anything, by their weights. 0 if none does.
  double errorInside(const Pictures& truth, const Pictures& other) const;

  /// Terrain that is looked at, and a typical error of its heights, in metres.
  struct Surface {
    const GroundRays& ground;
    const ScreenTexture& texture;
    double shift;
  };
  /// The costs of errors where a point shows the ground, as parts of the error over all cameras: of
  /// heights that are off by the shift; of texels, per square, if pixels resolved all of them.
  struct Worth {
    double column = 0, row = 0;  ///< GroundHit
    double heights = 0, texture = 0;
  };
  std::vector<Worth> worthsOf(const Surface& surface, Extent texels) const;

  /// The indices of the cameras that have a weight and see no ground.
  std::vector<size_t> blindCameras(const std::vector<SeenPoint>& seen) const;

 private:
  struct View {
    size_t camera, begin, end;  ///< points
    double weight;              ///< of 1
  };

  void addPoints(const Camera& camera, size_t count);
  /// Squared change of a point's colour if the ground that it shows rises or falls.
  double squaresMoved(const PicturePoint& point, const SeenPoint& seen, const GroundHit& plane,
                      const Surface& surface) const;

  std::vector<PicturePoint> points_;
  std::vector<View> views_;
};

}  // namespace tetrakis::inline pictures
