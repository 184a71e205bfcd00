// SPDX-License-Identifier: Apache-2.0
// Textured terrains of the benches that draw meshes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/report/scene.hpp"
#include "bench/peers/raster.hpp"
#include "codec/ground/camera.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {

struct TerrainFiles {
  std::filesystem::path heights, texture;
};

/// Folders that hold height.* and texture.*, whose path holds one of the filters if there are some.
std::vector<TerrainFiles> texturedTerrains(const std::vector<std::string>& folders,
                                           const std::vector<std::string>& filters);

struct ScreenTerrain {
  std::string item;
  Raster raster;
  tools::ImageFile texture;
  GroundFrame frame;  ///< of the raster's steps

  tools::Surface surface() const;
};

Result<ScreenTerrain> loadTerrain(const TerrainFiles& files);

/// The heights alone. psnr and the like: as options say.
Result<Buffer> encodeHeights(const Raster& raster, const tks_encode_options& options);

}  // namespace tetrakis::bench
