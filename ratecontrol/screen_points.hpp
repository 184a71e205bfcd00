// SPDX-License-Identifier: Apache-2.0
// The modelled engine of screen distortion (thesis 6.1 and 6.2): what cameras see of a terrain, at
// some thousand points of their pictures. A ray finds the ground below a point, so hidden ground
// counts nothing, near ground much, and a height error moves the texture as far as it does on the
// screen; the size of a pixel on the ground says which levels of the texture are seen. Averages
// over such points are the squared errors that a renderer would find, to some percent, and the
// same points for all surfaces and textures make their differences much better than that.
#pragma once

#include <cstddef>
#include <vector>

#include "base/plane.hpp"
#include "ground/camera.hpp"
#include "ratecontrol/ground_rays.hpp"
#include "ratecontrol/screen_texture.hpp"

namespace tetrakis::inline ratecontrol {

/// The ground that a point shows.
struct SeenPoint {
  bool ground = false;      ///< else it shows the sky
  double u = 0, v = 0;      ///< place in the texture, from 0 to 1
  double u_x = 0, v_x = 0;  ///< what a pixel to the right changes
  double u_y = 0, v_y = 0;  ///< what a pixel down changes
  double level = 0;         ///< of detail, as renderers choose it
  double metres = 0;        ///< that a pixel is high and wide there
};

class ScreenPoints {
 public:
  /// count: over all cameras, shared by their weights. At least one weight is positive.
  ScreenPoints(const std::vector<Camera>& cameras, size_t count);

  /// texture: its size in texels.
  std::vector<SeenPoint> seenOf(const GroundRays& ground, Extent texture) const;

  /// What each point looks like: means of four samples in a pixel.
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

  /// The same where one picture shows ground and the other one sky, for surfaces whose squared
  /// errors, in square metres, fall. Such errors are large and few points see them. But what an
  /// outline covers is in proportion to its shift, so to the error of the heights: those of coarser
  /// surfaces say what finer ones cover, so each is pooled with those before it until they have
  /// `enough` points at outlines in all.
  /// Pixels smooth a shift s of less than a pixel: an edge then errs by s^2 - s^3 / 3 pixels, by
  /// s - 1 / 3 beyond; but as they are means of 2 x 2 samples, of which one makes a sixteenth, by
  /// s / 4 at least.
  std::vector<double> errorsOfOutlines(const Pictures& truth, const std::vector<Pictures>& others,
                                       const std::vector<double>& squares, size_t enough) const;

  /// Terrain that is looked at, and a typical error of its heights, in metres.
  struct Surface {
    const GroundRays& ground;
    const ScreenTexture& texture;
    double shift;
  };
  /// What errors cost where a point shows the ground, as parts of the error over all cameras: of
  /// heights that are off by the shift; of texels, per square, as if pixels resolved them all.
  struct Worth {
    double column = 0, row = 0;  ///< GroundHit
    double heights = 0, texture = 0;
  };
  std::vector<Worth> worthsOf(const Surface& surface, Extent texels) const;

  /// Places in the list of cameras of those that have a weight and see no ground.
  std::vector<size_t> blindCameras(const std::vector<SeenPoint>& seen) const;

 private:
  struct Point {
    Ray ray;
    Vec3 right{}, down{};  ///< what a pixel changes of the direction
    Colour sky{};
  };
  struct View {
    size_t camera, begin, end;  ///< points
    double weight;              ///< of 1
  };

  /// Of the points of one view where one picture alone shows ground.
  struct Outline {
    double error = 0;   ///< as far as it belongs to the error of the view
    double metres = 0;  ///< of a pixel, summed
    size_t count = 0;
  };
  Outline outlineOf(const View& view, const Pictures& a, const Pictures& b) const;
  /// The surfaces from here to the last one have so many points, over all views. The first surface,
  /// that of no coefficients, says nothing of others.
  static size_t pooledFrom(const std::vector<std::vector<Outline>>& outlines, size_t enough);

  void addPoints(const Camera& camera, size_t count);
  /// Squared change of a point's colour if the ground that it shows rises or falls.
  double inside(const Point& point, const SeenPoint& seen, const GroundHit& plane,
                const Surface& surface) const;

  std::vector<Point> points_;
  std::vector<View> views_;
};

}  // namespace tetrakis::inline ratecontrol
