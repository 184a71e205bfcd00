// SPDX-License-Identifier: Apache-2.0
// PatchAtlas lays the texels of a forest out as a picture for meshes: its patches in rows and
// columns, each with a gutter of one texel around it that repeats its border. So renderers that
// take means of neighbouring texels find none of another patch.
#pragma once

#include <array>
#include <cstdint>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

class PatchAtlas {
 public:
  /// Of patches of (2^depth + 1) x (2^depth + 1) texels. patches: 1 or more.
  PatchAtlas(uint32_t patches, uint32_t depth);

  uint32_t width() const { return columns_ * cell(); }
  uint32_t height() const { return rows_ * cell(); }

  /// raster: that of the forest, with the patches one below the other.
  ImageFile pictureOf(const ImageFile& raster) const;

  /// Where a place of a patch lies on the picture, from (0, 0) to (1, 1) across it. x, y: from 0,
  /// the middle of the first texel of the patch, to 1, that of the last one.
  std::array<double, 2> at(uint32_t patch, double x, double y) const;

 private:
  uint32_t cell() const { return side_ + 2; }

  uint32_t patches_, side_, columns_, rows_;
};

}  // namespace tetrakis::tools
