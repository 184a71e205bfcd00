// SPDX-License-Identifier: Apache-2.0
// TrianglePictures is the engine of screen distortion for surfaces of any shape: it draws triangles
// for cameras, at some ten thousand pixels of their pictures. A pixel is the mean of four samples,
// so that outlines which move by a part of a pixel err as they do in a renderer's pictures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "codec/ground/camera.hpp"
#include "ratecontrol/pictures/picture_point.hpp"

namespace tetrakis::inline pictures {

/// Triangles in space, in the unit of the cameras. Either side of a triangle is seen.
struct DrawnTriangles {
  std::span<const Vec3> points;
  std::span<const std::array<uint32_t, 3>> triangles;
};

/// What a sample of a picture shows.
struct SeenTriangle {
  static constexpr uint32_t kSky = UINT32_MAX;
  uint32_t triangle = kSky;
  float second = 0, third = 0;  ///< weights of these corners at the place that is seen
  float samples = 0;            ///< of the picture that the triangle covers, were all pixels drawn
};

class TrianglePictures {
 public:
  /// cameras: checkCamera() admits them; at least one weight is positive.
  explicit TrianglePictures(std::vector<Camera> cameras);

  /// Samples of a pixel, which lie one behind the other.
  static constexpr size_t kSamples = 4;

  /// The samples of all cameras, camera by camera. A triangle that reaches behind a camera is not
  /// seen by it.
  std::vector<SeenTriangle> seenOf(const DrawnTriangles& mesh) const;

  /// The colours of all pixels, whose samples show the sky or a triangle. look: the colour of a
  /// sample, by its index, that shows a triangle.
  std::vector<Colour> coloursOf(std::span<const SeenTriangle> seen,
                                const std::function<Colour(size_t sample)>& look) const;

  /// Squared error of R, G or B over the pixels in which either shows a triangle; the mean over the
  /// cameras that see one, by their weights. 0 if none does.
  struct Pictures {
    std::span<const SeenTriangle> seen;
    std::span<const Colour> colours;
  };
  double errorBetween(const Pictures& truth, const Pictures& other) const;

  /// The index of the first camera with a weight that shows no triangle, or the number of cameras.
  size_t firstBlind(std::span<const SeenTriangle> seen) const;
  const std::vector<Camera>& cameras() const { return cameras_; }

 private:
  struct View {
    uint32_t columns, rows;  ///< of pixels
    size_t begin;            ///< its first pixel
    double weight;           ///< of 1
  };
  void draw(size_t camera, const DrawnTriangles& mesh, std::span<SeenTriangle> seen) const;

  std::vector<Camera> cameras_;
  std::vector<View> views_;  ///< one a camera
  uint32_t stride_;          ///< of all pixels every such one is drawn, in both directions
  size_t pixels_ = 0;        ///< that are drawn
};

}  // namespace tetrakis::inline pictures
