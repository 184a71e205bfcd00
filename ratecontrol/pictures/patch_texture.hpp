// SPDX-License-Identifier: Apache-2.0
// PatchTexture is the texture of a forest's patches as renderers show it: a pyramid of each patch,
// and trilinear filters between its texels. No patch shows texels of another one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/samples.hpp"
#include "ratecontrol/pictures/picture_point.hpp"
#include "ratecontrol/pictures/triangle_pictures.hpp"

namespace tetrakis::inline pictures {

/// A place of a patch, and how finely it is seen.
struct PatchPlace {
  uint32_t patch = 0;
  float u = 0, v = 0;  ///< from 0 to 1 along the sides of the patch
  float level = 0;     ///< of detail of the texture, 0 the finest
};

/// The place that a sample of a picture shows. The squares of each patch are 2^depth a side, row by
/// row, and make two triangles each: north-west, south-west, south-east and north-west, south-east,
/// north-east. texture_depth: patches have 2^texture_depth texels a side and one more.
PatchPlace patchPlaceOf(const SeenTriangle& seen, int depth, int texture_depth);

class PatchTexture {
 public:
  /// texels: the raster of patches of (2^depth + 1)^2 texels, one below the other.
  PatchTexture(const Texels& texels, int depth);

  Colour at(const PatchPlace& place) const;

 private:
  struct Level {
    uint32_t side;  ///< texels along a patch
    std::vector<Lanes> texels;
  };
  static Level halved(const Level& fine);
  static void addBilinear(const Level& level, const PatchPlace& place, float weight, Colour& sum);

  std::vector<Level> levels_;
};

}  // namespace tetrakis::inline pictures
