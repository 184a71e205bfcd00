// SPDX-License-Identifier: Apache-2.0
// The functions here make the texture of terrain tiles: pictures for the tiles of meshes, and tiles
// of imagery.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "apps/tools/tiles/ground_texture.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// Decodes mip levels of the texture as levels of tiles ask for them.
class TextureLevels {
 public:
  TextureLevels(Decoder& decoder, GroundTexture texture)
      : decoder_(decoder), texture_(std::move(texture)) {}

  const GroundTexture& texture() const { return texture_; }

  /// For texels of so many degrees of longitude and latitude. heights: the mip level of the heights
  /// that is set; beside: bytes that the caller holds.
  Status decodeFor(const std::array<double, 2>& degrees, uint32_t heights, uint64_t beside);

  /// The mip level that is decoded; 0 if none is yet.
  uint32_t level() const { return level_; }

 private:
  Decoder& decoder_;
  GroundTexture texture_;
  uint32_t level_ = 0;
  bool decoded_ = false;
};

/// Texels of the tiles of one level of meshes, the same for all of them: as many as the texture has
/// there, up to 256 a side. On the deepest level, where none finer follow, up to 2048; coarser
/// levels then have as many.
class MeshTexels {
 public:
  MeshTexels(const GroundTexture& texture, uint32_t deepest);

  TexelGrid gridOf(uint32_t level) const;

  /// Degrees of longitude and latitude of a texel.
  std::array<double, 2> degreesOf(uint32_t level) const;

  /// The error, in metres, of which a viewer that shows errors of up to 16 pixels, as Cesium does,
  /// makes texels of at most one; 0 where a tile has all that the texture has.
  double errorOf(uint32_t level) const;

 private:
  std::array<double, 2> density_;
  std::array<double, 2> most_;
};

struct ImagerySize {
  uint64_t tiles = 0, bytes = 0;
};

/// Writes FOLDER/LEVEL/X/Y.webp of 256 x 256 texels and FOLDER/tilemapresource.xml (TMS,
/// global-geodetic), from the deepest level of at most four tiles to the one that is as fine as the
/// texture. What the texture does not cover is transparent; tiles without any texel are left out.
Result<ImagerySize> writeImagery(Decoder& decoder, const std::string& folder);

}  // namespace tetrakis::tools
