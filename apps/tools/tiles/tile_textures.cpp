// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/tile_textures.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/meshes/mesh_writers.hpp"
#include "apps/tools/files/place/earth.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/tiles/tile_folders.hpp"

namespace tetrakis::tools {
namespace {

namespace fs = std::filesystem;

/// As maps have them; and what every viewer takes at once.
constexpr uint32_t kTexels = 256, kMostTexels = 2048;
constexpr uint32_t kDeepestImagery = 24;

/// The least multiple of 8, a block of JPEG, that holds so many texels with both edges.
double sideFor(double texels) {
  return 8 * std::ceil((texels + 1) / 8);
}

/// The attributes that Cesium's TileMapServiceImageryProvider reads among them.
std::string tileMap(const GeographicBounds& b, uint32_t first, uint32_t deepest) {
  const auto number = [](double value) { return nlohmann::json(value).dump(); };
  const std::string side = std::to_string(kTexels);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<TileMap version=\"1.0.0\" tilemapservice=\"http://tms.osgeo.org/1.0.0\">\n"
      "  <Title>Tetrakis</Title>\n  <Abstract/>\n  <SRS>EPSG:4326</SRS>\n"
      "  <BoundingBox minx=\"" +
      number(b.west) + "\" miny=\"" + number(b.south) + "\" maxx=\"" + number(b.east) +
      "\" maxy=\"" + number(b.north) +
      "\"/>\n"
      "  <Origin x=\"-180\" y=\"-90\"/>\n  <TileFormat width=\"" +
      side + "\" height=\"" + side +
      "\" mime-type=\"image/webp\" extension=\"webp\"/>\n"
      "  <TileSets profile=\"global-geodetic\">\n";
  for (uint32_t level = first; level <= deepest; ++level)
    text += "    <TileSet href=\"" + std::to_string(level) + "\" units-per-pixel=\"" +
            number(tileDegrees(level) / kTexels) + "\" order=\"" + std::to_string(level) + "\"/>\n";
  return text + "  </TileSets>\n</TileMap>\n";
}

class ImageryWriter {
 public:
  ImageryWriter(Decoder& decoder, GroundTexture texture, const GeographicBounds& bounds,
                std::string folder)
      : levels_(decoder, std::move(texture)), bounds_(bounds), folder_(std::move(folder)) {}

  Result<ImagerySize> write() {
    const std::array<double, 2>& density = levels_.texture().density();
    const double finest = std::max(density[0], density[1]);
    while (deepest_ < kDeepestImagery && finest * tileDegrees(deepest_) > kTexels) ++deepest_;
    while (first_ < deepest_ && tilesOver(bounds_, first_ + 1).count() <= 4) ++first_;
    for (uint32_t level = deepest_ + 1; level-- > first_;)
      if (const Status status = writeLevel(tilesOver(bounds_, level)); !status.ok()) return status;
    const std::string text = tileMap(bounds_, first_, deepest_);
    const std::string name = (fs::path(folder_) / "tilemapresource.xml").string();
    if (const Status status = writeBytes(name, std::as_bytes(std::span(text))); !status.ok())
      return status;
    return written_;
  }

 private:
  Status writeLevel(const TileRange& range) {
    const double texel = tileDegrees(range.level) / kTexels;
    if (const Status status = levels_.decodeFor({texel, texel}, 0, 0); !status.ok()) return status;
    return writeTiles(folder_, range, [this](const GeographicTile& tile, const fs::path& column) {
      return writeTile(tile, column);
    });
  }

  Status writeTile(const GeographicTile& tile, const fs::path& column) {
    const ImageFile picture =
        levels_.texture().piece(tile, {kTexels, kTexels}, TexelPlaces::kAreas, true);
    if (isEmpty(picture)) return {};
    const Result<EncodedTexture> coded = encodeTexture(picture, MeshTexture::kWebp);
    if (!coded.ok()) return coded.status();
    ++written_.tiles;
    written_.bytes += coded->bytes.size();
    return writeBytes((column / (std::to_string(tile.y) + ".webp")).string(), coded->bytes);
  }

  static bool isEmpty(const ImageFile& picture) {
    if (picture.channels % 2 != 0) return false;
    for (size_t i = picture.channels - 1; i < picture.data.size(); i += picture.channels)
      if (picture.data[i] != std::byte{0}) return false;
    return true;
  }

  TextureLevels levels_;
  GeographicBounds bounds_;
  std::string folder_;
  uint32_t first_ = 0, deepest_ = 0;
  ImagerySize written_;
};

}  // namespace

Status TextureLevels::decodeFor(const std::array<double, 2>& degrees, uint32_t heights,
                                uint64_t beside) {
  const uint32_t level = texture_.mipFor(degrees);
  if (decoded_ && level == level_) return {};
  texture_.use({}, 0);
  if (const Status status = decoder_.setLevels(heights, level); !status.ok()) return status;
  level_ = level;
  Result<ImageFile> image = decodeImage(decoder_, {}, beside + imageBytes(decoder_.info()));
  if (!image.ok()) return image.status();
  texture_.use(std::move(*image), level);
  decoded_ = true;
  return {};
}

MeshTexels::MeshTexels(const GroundTexture& texture, uint32_t deepest)
    : density_(texture.density()) {
  for (size_t axis = 0; axis < 2; ++axis)
    most_[axis] =
        std::clamp<double>(sideFor(density_[axis] * tileDegrees(deepest)), kTexels, kMostTexels);
}

TexelGrid MeshTexels::gridOf(uint32_t level) const {
  const auto side = [this, level](size_t axis) {
    return static_cast<uint32_t>(
        std::min(sideFor(density_[axis] * tileDegrees(level)), most_[axis]));
  };
  return {side(0), side(1)};
}

std::array<double, 2> MeshTexels::degreesOf(uint32_t level) const {
  const TexelGrid grid = gridOf(level);
  return {tileDegrees(level) / (grid.across - 1), tileDegrees(level) / (grid.down - 1)};
}

double MeshTexels::errorOf(uint32_t level) const {
  constexpr double kPixels = 16;
  const double degrees = degreesOf(level)[1];
  return degrees * density_[1] > 1 ? kPixels * degrees * metresPerDegree(0).north : 0;
}

Result<ImagerySize> writeImagery(Decoder& decoder, const std::string& folder) {
  if (const Status status = decoder.setLevels(0, 0); !status.ok()) return status;
  Result<GroundTexture> texture = GroundTexture::create(decoder.info());
  if (!texture.ok()) return texture.status();
  const Result<GeographicBounds> bounds = texture->bounds();
  if (!bounds.ok()) return bounds.status();
  return ImageryWriter(decoder, std::move(*texture), *bounds, folder).write();
}

}  // namespace tetrakis::tools
