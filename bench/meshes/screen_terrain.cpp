// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/screen_terrain.hpp"

#include <algorithm>
#include <map>

namespace tetrakis::bench {

namespace fs = std::filesystem;

std::vector<TerrainFiles> texturedTerrains(const std::vector<std::string>& folders,
                                           const std::vector<std::string>& filters) {
  std::map<fs::path, TerrainFiles> found;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const fs::path& path = entry.path();
      if (path.stem() == "height") found[path.parent_path()].heights = path;
      if (path.stem() == "texture") found[path.parent_path()].texture = path;
    }
  std::vector<TerrainFiles> terrains;
  for (const auto& [folder, files] : found) {
    const std::string text = folder.string();
    const auto matches = [&](const std::string& f) { return text.find(f) != std::string::npos; };
    if (!files.heights.empty() && !files.texture.empty() &&
        (filters.empty() || std::any_of(filters.begin(), filters.end(), matches)))
      terrains.push_back(files);
  }
  return terrains;
}

tools::Surface ScreenTerrain::surface() const {
  return {raster.width, raster.height, {raster.samples.begin(), raster.samples.end()}};
}

Result<ScreenTerrain> loadTerrain(const TerrainFiles& files) {
  const Result<tools::HeightFile> heights = tools::readHeights(files.heights.string());
  if (!heights.ok()) return heights.status();
  Result<Raster> raster = heightRaster(*heights);
  if (!raster.ok()) return raster.status();
  Result<tools::ImageFile> texture = tools::readImage(files.texture.string());
  if (!texture.ok()) return texture.status();
  ScreenTerrain terrain{files.heights.parent_path().filename().string(), std::move(*raster),
                        std::move(*texture), tools::frameOf(*heights)};
  terrain.frame.metres_per_unit *= terrain.raster.unit;
  return terrain;
}

Result<Buffer> encodeHeights(const Raster& raster, const tks_encode_options& options) {
  tks_heights heights = makeHeights();
  heights.width = raster.width;
  heights.height = raster.height;
  heights.sample = TKS_U16;
  heights.data = raster.samples.data();
  return encode(&heights, nullptr, options);
}

}  // namespace tetrakis::bench
