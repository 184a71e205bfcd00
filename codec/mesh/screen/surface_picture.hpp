// SPDX-License-Identifier: Apache-2.0
// screenWeights() takes a surface and the cameras that look at it and returns the weight of each
// sample in their pictures, by which meshes err where nobody sees it. SurfacePicture draws what a
// camera sees for that.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "codec/mesh/surface/surface.hpp"

namespace tetrakis::inline screen {

// SurfacePicture draws a surface as a camera sees it, and holds for each pixel how near the ground
// is and how bright.
//
// A plain z-buffer over all triangles of the grid. Its numbers take part in choosing the vertices
// of meshes, so they come from IEEE additions, multiplications, divisions, square roots and
// comparisons alone: the same bits with every compiler, and no library of mathematics.

/// A camera. clip: row by row, takes (column, row, height in steps, 1) to clip coordinates, y up in
/// the picture; the third row is not used. All numbers are finite.
struct ScreenView {
  uint32_t width = 0, height = 0;  ///< pixels, 1 or more
  std::array<double, 16> clip{};
  double weight = 1;  ///< what the picture counts; above 0
};

struct ScreenPoint {
  double x = 0, y = 0;  ///< pixels from the picture's top left corner
  double nearness = 0;  ///< 1 / w; 0: behind the camera, or far beside the picture
};

/// Pixels by which a point of the picture moves.
struct ScreenVector {
  double x = 0, y = 0;
};

class ScreenProjection {
 public:
  explicit ScreenProjection(const ScreenView& view) : view_(view) {}

  ScreenPoint operator()(double column, double row, double height) const;
  /// How far a point that is seen moves in the picture for a step of 1 along an axis: 0 columns,
  /// 1 rows, 2 heights.
  ScreenVector along(size_t axis, const ScreenPoint& point) const;

 private:
  const ScreenView& view_;
};

/// Brightness of an image that covers the ground from the first sample to the last, at halves of
/// its resolution. Empty: there is no image.
class GroundImage {
 public:
  GroundImage() = default;
  /// texels: width * height, row by row.
  GroundImage(uint32_t width, uint32_t height, std::vector<uint8_t> texels);

  /// (R + 2 G + B) / 4; grey as it is. sample: the i-th of an image of 1 to 4 channels, in 8 bits.
  template <class Sample>
  static GroundImage of(uint32_t width, uint32_t height, uint32_t channels, Sample&& sample) {
    std::vector<uint8_t> brightness(size_t{width} * height);
    for (size_t i = 0, at = 0; i < brightness.size(); ++i, at += channels) {
      const uint32_t weighed =
          channels < 3 ? 4 * sample(at) : sample(at) + 2 * sample(at + 1) + sample(at + 2) + 2;
      brightness[i] = static_cast<uint8_t>(weighed / 4);
    }
    return GroundImage(width, height, std::move(brightness));
  }

  bool empty() const { return levels_.empty(); }
  double texels() const { return static_cast<double>(levels_[0].texels.size()); }
  /// Bilinear, x and y from 0 to 1, where a pixel covers so many texels of the image.
  double at(double x, double y, double texels_a_pixel) const;

 private:
  struct Level {
    uint32_t width, height;
    std::vector<uint8_t> texels;
  };
  std::vector<Level> levels_;
};

class SurfacePicture {
 public:
  /// Draws the triangles of full resolution whose corners are known. Where these overlap so much
  /// that drawing takes time for the samples times the pixels, it draws those of every second,
  /// fourth, … sample. Without an image all ground is of one brightness.
  SurfacePicture(const WeightedSurface& surface, const ScreenView& view, const GroundImage& image);

  /// Pixels that show ground.
  size_t covered() const { return covered_; }
  /// Whether the picture shows such a point of the surface: it may lie a little behind the ground
  /// of its own or of a neighbouring pixel.
  bool shows(const ScreenPoint& point) const;
  /// Bilinear; beyond the border of the picture that of the border.
  double brightness(double x, double y) const;

 private:
  struct Corner {
    ScreenPoint screen;
    double column = 0, row = 0;
  };
  using Corners = std::array<Corner, 3>;
  /// Pixels whose middles lie in the box around a triangle, borders included.
  struct Box {
    double left, top, right, bottom;
    double pixels() const;
  };

  /// Calls see(corners) for the triangles of every stride-th sample and those of the border.
  template <class See>
  void forEachTriangle(const WeightedSurface& surface, const ScreenView& view, uint32_t stride,
                       See&& see) const;
  uint32_t strideOf(const WeightedSurface& surface, const ScreenView& view) const;
  Box boxOf(const Corners& corners) const;
  void draw(const Corners& corners, const GroundImage& image);

  uint32_t width_, height_;
  double last_column_, last_row_;  ///< of the surface
  std::vector<float> nearness_;    ///< of each pixel, 0: sky
  std::vector<uint8_t> brightness_;
  size_t covered_ = 0;
};

// screenWeights() gives each sample of a surface a weight: the cost of a height error there in the
// pictures of cameras (thesis 6.1, figure 6.4). Meshes with these weights err least on the screen.
//
// A sample that is too high by e moves the ground that it carries by e v on the screen, v =
// d(screen) / d(height). The picture I then errs by I(s) - I(s - e v) wherever that ground is seen:
// by the squared derivative of the picture along v, on as many pixels as the sample covers. So
//
//   weight = sum over cameras of  c A |v|^2 D,  c = weight of the camera / pixels that show ground
//
// A: pixels that the sample covers, the determinant of its ground axes on the screen; 0 where it is
// hidden. D: mean squared difference of brightness to the pixels a pixel away, along v and against
// it; ground with little in it, and ground seen from above, gets few triangles, and outlines before
// the sky many. Without an image all ground has the same detail, of a sample's size: D = min(1, 1 /
// A). Hidden ground keeps a 64th of the mean, so that meshes stay sensible where cameras do not
// look.

/// Returns a weight for each sample, for SurfaceView::weights: means over 3 x 3 samples, rounded to
/// multiples of 2^-10 of the mean of all, from 2^-6 to 2^14; 1 where a sample is not known, and
/// everywhere if no view sees ground. The surface's own weights do not count. The same bits with
/// every compiler.
std::vector<float> screenWeights(const WeightedSurface& surface, std::span<const ScreenView> views,
                                 const GroundImage& image);

/// Bytes that this takes at most beside what it is given: weights, costs, and a picture.
uint64_t screenWeightsBytes(uint64_t samples);

}  // namespace tetrakis::inline screen
