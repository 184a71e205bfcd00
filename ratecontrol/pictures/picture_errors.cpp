// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/pictures/picture_errors.hpp"

namespace tetrakis::inline pictures {

namespace {

/// Columns in which outlines are followed, over all cameras. More of them tell their shifts more
/// exactly, and take rays.
constexpr size_t kOutlineColumns = 256;

}  // namespace

PictureErrors::PictureErrors(const std::vector<Camera>& cameras, size_t pixels,
                             const GroundRays& ground, const Texels& texels)
    : texels_(texels.extent()),
      true_texture_(texels, texels_),
      points_(cameras, pixels),
      outlines_(cameras, kOutlineColumns, ground, true_texture_, texels_),
      true_surface_{points_.seenOf(ground, texels_)},
      true_colours_(points_.coloursOf(true_surface_.seen, true_texture_)) {}

PictureErrors::Surface PictureErrors::surfaceOf(const GroundRays& ground) const {
  return {points_.seenOf(ground, texels_), outlines_.errorOf(ground)};
}

double PictureErrors::errorInside(const Surface& surface, const ScreenTexture& texture) const {
  const std::vector<Colour> colours = points_.coloursOf(surface.seen, texture);
  return points_.errorInside({true_surface_.seen, true_colours_}, {surface.seen, colours});
}

}  // namespace tetrakis::inline pictures
