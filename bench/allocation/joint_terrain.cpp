// SPDX-License-Identifier: Apache-2.0
#include "bench/allocation/joint_terrain.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/tools/report/picture_judge.hpp"
#include "bench/harness/height_files.hpp"

namespace tetrakis::bench {

std::vector<std::filesystem::path> terrainsBelow(const std::vector<std::string>& folders,
                                                 const std::vector<std::string>& filters) {
  std::vector<std::filesystem::path> terrains;
  for (const std::filesystem::path& heights :
       filesBelow(folders, filters, [](const std::filesystem::path& path) {
         return path.filename() == "height.tif" &&
                std::filesystem::exists(path.parent_path() / "texture.png");
       }))
    terrains.push_back(heights.parent_path());
  return terrains;
}

Result<Terrain> readTerrain(const std::filesystem::path& folder, double spacing) {
  Result<tools::HeightFile> heights = tools::readHeights((folder / "height.tif").string());
  if (!heights.ok()) return heights.status();
  Result<tools::ImageFile> image = tools::readImage((folder / "texture.png").string());
  if (!image.ok()) return image.status();
  if (spacing > 0) heights->spacing_x = heights->spacing_y = spacing;
  return Terrain{folder.filename().string(), {std::move(*heights), std::move(*image)}};
}

Result<EncodedTerrain> encodeTerrain(const tools::Reference& original,
                                     const StreamRequest& request) {
  const tks_heights heights = tools::asHeights(*original.heights);
  const tks_image image = tools::asImage(*original.image);
  tks_encode_options options = makeEncodeOptions();
  options.bytes = request.bytes;
  options.regions = 1;
  options.triangles = request.triangles;
  const tools::PlacedFrame frame = tools::frameOf(*original.heights);
  const auto cameras = tools::chooseCameras(
      {"", request.view}, tools::boundsOf(tools::heightsOf(*original.heights), frame));
  if (!cameras.ok()) return cameras.status();
  const std::vector<tks_camera> those = tools::toldCameras(*cameras, frame.axes);
  if (request.knows != Knows::kNothing) {
    options.cameras = those.data();
    options.camera_count = static_cast<uint32_t>(those.size());
  }
  std::optional<tools::PictureJudge> renderer;
  if (request.knows == Knows::kPictures) {
    auto judge = tools::PictureJudge::create(*original.heights, *original.image, *cameras);
    if (!judge.ok()) return judge.status();
    options.picture_error = &tools::PictureJudge::error;
    options.picture_user = &renderer.emplace(std::move(*judge));
  }
  Result<Buffer> stream = tetrakis::encode(&heights, &image, options);
  if (!stream) return stream.status();
  return EncodedTerrain{std::move(*stream), renderer ? renderer->drawn() : 0};
}

}  // namespace tetrakis::bench
