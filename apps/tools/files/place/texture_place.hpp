// SPDX-License-Identifier: Apache-2.0
// TexturePlace tells where samples of heights lie in a texture that may have a place of its own: an
// orthophoto that begins elsewhere than the heights, covers more of the ground or less, is turned
// against them, or has another reference system.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "apps/tools/files/files.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::tools {

/// A raster, and its place as far as it is known.
struct PlacedRaster {
  uint32_t width = 0, height = 0;
  std::optional<GeoTransform> transform;
  std::string crs;
  bool round = false;  ///< the last column lies beside the first one

  static PlacedRaster heightsOf(const tks_info& info);
  /// crs: that of the heights, where the texture has none of its own.
  static PlacedRaster textureOf(const tks_info& info);
  /// A file of heights or an image, and its georeference.
  PlacedRaster(uint32_t columns, uint32_t rows, const Georeference& place)
      : width(columns), height(rows), transform(place.geotransform), crs(place.crs) {}

 private:
  PlacedRaster() = default;
};

class TexturePlace {
 public:
  /// A texture covers the heights from the first sample to the last where one of the two has no
  /// geotransform, or PROJ does not know how their reference systems lie to each other.
  TexturePlace(const PlacedRaster& heights, const PlacedRaster& texture);

  /// Whether it covers other ground than from the first sample to the last, by more than a sample.
  bool isOwn() const { return own_; }

  /// Of one that is its own: whether that is the same ground, and only the first texel lies over
  /// another corner of it than the first sample.
  bool isTurned() const { return turned_; }

  /// Column and row of a texel, (0, 0) the outer corner of the first, where a sample lies, (0, 0)
  /// the first. May lie outside; not finite where a projection has no place. Not thread safe.
  std::array<double, 2> texelAt(double column, double row) const { return texel_at_(column, row); }

  /// The texels whose middles lie over the areas of these samples, or the nearest one where none
  /// does: adjoining windows have adjoining texels. Nothing if the texture lies beside. Of one that
  /// is round they begin inside, and may go on behind the last column with the first.
  std::optional<tks_window> texelsOver(const tks_window& samples) const;

 private:
  uint32_t width_, height_;  ///< of the texture
  bool round_;
  std::function<std::array<double, 2>(double, double)> texel_at_;
  bool own_ = false, turned_ = false;
};

}  // namespace tetrakis::tools
