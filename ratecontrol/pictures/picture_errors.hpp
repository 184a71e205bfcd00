// SPDX-License-Identifier: Apache-2.0
// PictureErrors takes a terrain with its cameras and returns how far the cameras' pictures of other
// surfaces and textures are from those of the terrain: by ScreenPoints on the ground, by Outlines
// where the ground ends before the sky.
#pragma once

#include <cstddef>
#include <vector>

#include "base/plane.hpp"
#include "base/samples.hpp"
#include "codec/ground/camera.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"
#include "ratecontrol/pictures/picture_point.hpp"

namespace tetrakis::inline pictures {

// Outlines measures the error of pictures where the ground ends before the sky. Errors there are
// large and lie at few pixels, which points spread over a picture hardly meet. So some hundred
// columns of the pictures say where they meet the outlines of the true ground, and how far the
// outlines of another surface have moved. An outline that moves by some pixels shows ground instead
// of sky, or sky instead of ground.

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

// PictureErrors measures how far the cameras' pictures of other surfaces and textures are from
// those of the true terrain: inside the ground by points, at its end before the sky by columns. The
// error of a picture is the sum of both.

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
