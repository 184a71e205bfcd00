// SPDX-License-Identifier: Apache-2.0
// GroundTexture cuts pieces of a stream's texture for tiles of longitude and latitude, by the
// texture's own georeference.
#pragma once

#include <array>
#include <cstdint>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/place/raster_place.hpp"
#include "apps/tools/tiles/geographic_tile.hpp"
#include "apps/tools/tiles/round_place.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// How the texels of a tile lie in it.
enum class TexelPlaces {
  /// The outer ones have their middles on the edges. A sampler that clamps then gives neighbours
  /// the same colours all along the edge that they share.
  kOnEdges,
  /// Each has an equal part of the tile: pictures as maps have them.
  kAreas
};

/// Texels across and down.
struct TexelGrid {
  uint32_t across, down;
};

/// Not thread safe.
class GroundTexture {
 public:
  /// Of a stream of heights and texture, on level 0. A texture without a georeference reaches from
  /// the middle of the first sample of the heights to that of the last, as on meshes. TKS_USAGE if
  /// its place cannot be found.
  static Result<GroundTexture> create(const tks_info& info);

  /// Texels of the texture along a degree of longitude and of latitude, in the middle of it.
  const std::array<double, 2>& density() const { return density_; }

  /// The mip level for a texel of so many degrees: its texels are the smallest that are no smaller
  /// than half of one.
  uint32_t mipFor(const std::array<double, 2>& degrees) const;

  /// Takes the decoded texture of a mip level.
  void use(ImageFile mip, uint32_t level);

  /// 8 bits a channel. Beyond the texture lie the colours of its edge, but where its columns go
  /// round the Earth, those of its other end; cut: with alpha, which is 0
  /// there. Opaque pieces have no alpha.
  ImageFile piece(const GeographicTile& tile, const TexelGrid& grid, TexelPlaces places,
                  bool cut) const;

  /// TKS_USAGE if it does not lie on the globe in one piece.
  Result<GeographicBounds> bounds() const;

 private:
  GroundTexture(RasterPlace place, const tks_info& info);
  /// Of the mip level, on both sides of a column of the texture.
  SamplesBeside columnsAt(double pixel) const;

  RasterPlace place_;
  uint32_t width_, height_, coarsest_level_;
  uint32_t round_ = 0;  ///< columns once round the Earth; 0: it does not go round
  std::array<double, 2> density_{};
  ImageFile mip_;  ///< 8 bits
  uint32_t level_ = 0;
};

}  // namespace tetrakis::tools
