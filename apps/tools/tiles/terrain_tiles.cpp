// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/terrain_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/report/scene.hpp"
#include "apps/tools/tiles/ground_tileset.hpp"
#include "apps/tools/tiles/quantized_mesh.hpp"
#include "apps/tools/tiles/tile_folders.hpp"
#include "apps/tools/tiles/tile_textures.hpp"

namespace tetrakis::tools {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr uint32_t kDeepest = 24;
/// Levels of availability in the metadata of a tile.
constexpr uint32_t kMetadataLevels = 10;
/// How deep skirts are, in errors of the level: as those that Cesium makes.
constexpr double kSkirtErrors = 5;

/// What Cesium takes the error of a level's tiles for: a quarter of a cell at the equator.
double levelError(uint32_t level) {
  constexpr double kEquator = 40075016.685578488;
  return std::ldexp(kEquator / (2 * kTileCells) / 4, -static_cast<int>(level));
}

/// Levels that are made of the grid of a cube, which has none itself.
constexpr uint32_t kMostCubeLevels = 16;

/// The least level whose cells are no longer than the spacing of the samples.
uint32_t deepestLevel(double spacing) {
  uint32_t level = 0;
  while (level < kDeepest && tileDegrees(level) / kTileCells > spacing) ++level;
  return level;
}

json rangeJson(const TileRange& range) {
  json ranges = json::array();
  ranges.push_back(
      {{"startX", range.x0}, {"startY", range.y0}, {"endX", range.x1}, {"endY", range.y1}});
  return ranges;
}

Status noGround() {
  return {TKS_USAGE, "the heights are void: there is no ground to make tiles of"};
}

/// Writes level by level, from the deepest up.
class TileWriter {
 public:
  TileWriter(Decoder& decoder, const EarthGround& ground, const TileOptions& options,
             std::string folder)
      : decoder_(decoder),
        ground_(ground),
        options_(options),
        folder_(std::move(folder)),
        tileset_(ground.bounds()) {}

  /// Before anything is decoded.
  Status prepare() {
    written_.deepest = deepestLevel(ground_.spacing());
    metres_ = frameOf(decoder_.info()).metres_per_unit;
    for (uint32_t level = 0; level <= written_.deepest; ++level)
      ranges_.push_back(tilesOver(ground_.bounds(), level));
    while (meshes() && written_.first < written_.deepest &&
           ranges_[written_.first + 1].count() <= 4)
      ++written_.first;
    if (meshes() && decoder_.info().has_texture) {
      Result<GroundTexture> texture = GroundTexture::create(decoder_.info());
      if (!texture.ok()) return texture.status();
      texels_.emplace(*texture, written_.deepest);
      texture_.emplace(decoder_, std::move(*texture));
    }
    return checkMemory();
  }

  Result<TileSetSize> write(const std::function<void(double)>& progress) {
    for (uint32_t level = written_.deepest + 1; level-- > written_.first;) {
      if (Status status = decodeFor(level); !status.ok()) return status;
      if (level == written_.deepest && surface_.allVoid()) return noGround();
      TerrainLevel terrain(ground_, surface_, metres_, ranges_[level]);
      if (level == written_.deepest) heights_ = rangeOf(surface_);
      terrain.chooseVertices(levelError(level) / 2, meshes());
      if (texture_) {
        const uint64_t held = surface_.heights.size() * sizeof(float);
        const Status status = texture_->decodeFor(texels_->degreesOf(level), surface_.level, held);
        if (!status.ok()) return status;
      }
      if (Status status = writeLevel(terrain); !status.ok()) return status;
      progress(1 - std::ldexp(1, -2 * static_cast<int>(written_.deepest + 1 - level)));
    }
    if (written_.tiles == 0) return noGround();
    const json document = meshes() ? tileset_.document() : layer();
    const std::string text = document.dump(2) + "\n";
    const char* const name = meshes() ? "tileset.json" : "layer.json";
    const Status status =
        writeBytes((fs::path(folder_) / name).string(), std::as_bytes(std::span(text)));
    if (!status.ok()) return status;
    if (!meshes() && decoder_.info().has_texture) {
      const Result<ImagerySize> imagery =
          writeImagery(decoder_, (fs::path(folder_) / "imagery").string());
      if (!imagery.ok()) return imagery.status();
      written_.pictures = imagery->tiles;
      written_.bytes += imagery->bytes;
    }
    return written_;
  }

 private:
  bool meshes() const { return options_.format == TileFormat::k3dTiles; }

  Status checkMemory() {
    const tks_info& info = decoder_.info();
    const uint64_t cells = ranges_.back().count() * kTileCells * kTileCells;
    const uint64_t samples = uint64_t{info.width} * info.height +
                             (isGridOnCube(info) ? shownHeights(info).samples() : 0);
    return decoder_
        .checkMemory(TKS_PART_HEIGHTS, nullptr, 0,
                     sizeof(float) * samples + 3 * sizeof(float) * cells)
        .status();
  }

  /// Mip levels follow the levels of tiles, as far as there are some.
  Status decodeFor(uint32_t level) {
    const tks_info& info = decoder_.info();
    const bool cube = isGridOnCube(info);
    const uint32_t mip =
        std::min(written_.deepest - level, cube ? kMostCubeLevels : info.coarsest_level);
    if (!surface_.heights.empty() && surface_.level == mip) return {};
    if (cube && !surface_.heights.empty()) {
      surface_ = coarser(surface_, ground_.columnsRound() > 0);
      return {};
    }
    surface_.heights.clear();
    if (Status set = decoder_.setLevels(cube ? 0 : mip, texture_ ? texture_->level() : 0);
        !set.ok())
      return set;
    Result<std::vector<float>> heights = decoder_.surface();
    if (heights.ok() && cube) heights = gridOfCube(info, *heights);
    if (!heights.ok()) return heights.status();
    const Extent extent = shownHeights(info);
    surface_ = {std::move(*heights), extent.width, extent.height, mip};
    return {};
  }

  /// One for all tiles. Ground that is not covered has the height 0; where a mip level overshoots
  /// the samples, it is cut.
  HeightRange rangeOf(const LevelSurface& surface) const {
    double low = 0, high = 0;
    for (const float height : surface.heights) {
      if (std::isnan(height)) continue;
      low = std::min(low, height * metres_);
      high = std::max(high, height * metres_);
    }
    return {static_cast<float>(low), static_cast<float>(high)};
  }

  Status writeLevel(const TerrainLevel& terrain) {
    return writeTiles(folder_, terrain.range(),
                      [&](const GeographicTile& tile, const fs::path& column) {
                        return writeTile(terrain, tile, column);
                      });
  }

  Status writeTile(const TerrainLevel& terrain, const GeographicTile& tile,
                   const fs::path& column) {
    const TileMesh mesh = terrain.meshOf(tile);
    std::vector<std::byte> bytes;
    if (meshes()) {
      TileMesh ground = groundOf(mesh);
      if (options_.skirts) addSkirts(ground, kSkirtErrors * levelError(tile.level));
      Result<std::vector<std::byte>> glb = addGround(ground, tile);
      if (!glb.ok()) return glb.status();
      if (glb->empty()) return {};
      bytes = std::move(*glb);
    } else {
      bytes = encodeQuantizedMesh(mesh, tile, heights_, metadataOf(tile));
    }
    const std::string name = std::to_string(tile.y) + (meshes() ? ".glb" : ".terrain");
    const Status status = writeBytes((column / name).string(), bytes);
    if (!status.ok()) return status;
    ++written_.tiles;
    written_.bytes += bytes.size();
    return {};
  }

  Result<std::vector<std::byte>> addGround(const TileMesh& ground, const GeographicTile& tile) {
    const double error = levelError(tile.level);
    if (!texture_ || ground.triangles.empty())
      return tileset_.add(ground, tile, {error, error}, nullptr);
    const ImageFile picture =
        texture_->texture().piece(tile, texels_->gridOf(tile.level), TexelPlaces::kOnEdges, false);
    const double shown = std::max(error, texels_->errorOf(tile.level));
    return tileset_.add(ground, tile, {error, shown}, &picture);
  }

  /// Which tiles there are below this one, on every tenth level.
  std::string metadataOf(const GeographicTile& tile) const {
    if (tile.level % kMetadataLevels != 0) return "";
    json available = json::array();
    for (uint32_t down = 1; down <= kMetadataLevels; ++down) {
      if (tile.level + down > written_.deepest) break;
      TileRange range = ranges_[tile.level + down];
      available.push_back(below(tile, range) ? rangeJson(range) : json::array());
    }
    return json{{"available", available}}.dump();
  }

  json layer() const {
    json available = json::array();
    for (const TileRange& range : ranges_) available.push_back(rangeJson(range));
    const GeographicBounds& b = ground_.bounds();
    return json{{"tilejson", "2.1.0"},
                {"name", "Tetrakis"},
                {"version", "1.0.0"},
                {"format", "quantized-mesh-1.0"},
                {"scheme", "tms"},
                {"tiles", json::array({"{z}/{x}/{y}.terrain?v={version}"})},
                {"projection", "EPSG:4326"},
                {"bounds", json::array({-180, -90, 180, 90})},
                {"valid_bounds", json::array({b.west, b.south, b.east, b.north})},
                {"minzoom", 0},
                {"maxzoom", written_.deepest},
                {"extensions", json::array({"octvertexnormals", "metadata"})},
                {"metadataAvailability", kMetadataLevels},
                {"available", available}};
  }

  Decoder& decoder_;
  const EarthGround& ground_;
  TileOptions options_;
  std::string folder_;
  GroundTileset tileset_;
  std::optional<TextureLevels> texture_;
  std::optional<MeshTexels> texels_;
  double metres_ = 1;
  std::vector<TileRange> ranges_;  ///< by level
  LevelSurface surface_;
  HeightRange heights_;
  TileSetSize written_;
};

}  // namespace

Result<TileSetSize> writeTerrainTiles(Decoder& decoder, const TileOptions& options,
                                      const std::string& folder,
                                      const std::function<void(double)>& progress) {
  const Result<EarthGround> ground = EarthGround::create(decoder.info());
  if (!ground.ok()) return ground.status();
  TileWriter writer(decoder, *ground, options, folder);
  if (Status status = writer.prepare(); !status.ok()) return status;
  return writer.write(progress);
}

}  // namespace tetrakis::tools
