// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/ground_tileset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "apps/tools/files/meshes/mesh_writers.hpp"
#include "apps/tools/files/place/earth.hpp"
#include "apps/tools/tiles/placed_mesh.hpp"

namespace tetrakis::tools {
namespace {

using nlohmann::json;

/// The least power of two of which 2^22 reach across a tile of a level, so that floats hold every
/// multiple of it that is needed.
double positionStep(uint32_t level) {
  const double side = tileDegrees(level) * std::numbers::pi / 180 * kSemiMajor;
  return std::exp2(std::ceil(std::log2(side * std::numbers::sqrt2)) - 22);
}

double nearestMultiple(double value, double step) {
  return std::round(value / step) * step;
}

/// From the axes of the Earth to those of glTF, where y is up; viewers turn them back.
Vector inGltfAxes(const Vector& v) {
  return {v[0], v[2], -v[1]};
}

/// From the middle of the first texel to that of the last.
void addTexcoords(const TileMesh& mesh, const ImageFile& texture, MeshFile& file) {
  const auto along = [](uint32_t cells, uint32_t texels) {
    return static_cast<float>((0.5 + double(cells) / kTileCells * (texels - 1)) / texels);
  };
  for (const TileMesh::Vertex& v : mesh.vertices) {
    file.texcoords.push_back(along(v.column, texture.width));
    file.texcoords.push_back(along(kTileCells - v.row, texture.height));
  }
  file.texture = &texture;
}

MeshFile meshFileOf(const TileMesh& mesh, const GeographicTile& tile, const ImageFile* texture) {
  const Placed placed = place(mesh, tile);
  const double step = positionStep(tile.level);
  MeshFile file;
  for (size_t k = 0; k < 3; ++k) {
    double low = placed.positions[0][k], high = low;
    for (const Vector& p : placed.positions) {
      low = std::min(low, p[k]);
      high = std::max(high, p[k]);
    }
    file.origin[k] = nearestMultiple((low + high) / 2, step);
  }
  for (size_t i = 0; i < placed.positions.size(); ++i) {
    Vector offset;
    for (size_t k = 0; k < 3; ++k)
      offset[k] = nearestMultiple(placed.positions[i][k], step) - file.origin[k];
    for (const double value : inGltfAxes(offset))
      file.positions.push_back(static_cast<float>(value));
    for (const double value : inGltfAxes(placed.normals[i]))
      file.normals.push_back(static_cast<float>(value));
  }
  file.origin = inGltfAxes(file.origin);
  file.triangles = mesh.triangles;
  if (texture) addTexcoords(mesh, *texture, file);
  return file;
}

/// Degrees to the radians and metres of a bounding volume.
json volumeOf(const GeographicBounds& b, double lowest, double highest) {
  constexpr double kRadian = std::numbers::pi / 180;
  return {{"region",
           {b.west * kRadian, b.south * kRadian, b.east * kRadian, b.north * kRadian, lowest,
            highest}}};
}

/// How far the ground reaches, in metres: what is missing where nothing is shown.
double extentOf(const GeographicBounds& b) {
  const MetresPerDegree metres = metresPerDegree((b.south + b.north) / 2);
  return std::hypot((b.east - b.west) * metres.east, (b.north - b.south) * metres.north);
}

/// A tile without ground of its own shows nothing, from however near: those below it take its
/// place.
void adopt(json& children, json tile) {
  if (tile.contains("content")) {
    children.push_back(std::move(tile));
  } else {
    for (json& child : tile["children"]) children.push_back(std::move(child));
  }
}

bool onOneSide(const TileMesh::Vertex& a, const TileMesh::Vertex& b) {
  const auto outer = [](uint32_t cells) { return cells == 0 || cells == kTileCells; };
  return (a.column == b.column && outer(a.column)) || (a.row == b.row && outer(a.row));
}

}  // namespace

TileMesh groundOf(const TileMesh& mesh) {
  TileMesh ground;
  std::vector<std::optional<uint32_t>> numbers(mesh.vertices.size());
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const std::span<const uint32_t> corners = std::span(mesh.triangles).subspan(i, 3);
    const auto covered = [&mesh](uint32_t corner) { return mesh.vertices[corner].ground; };
    if (!std::all_of(corners.begin(), corners.end(), covered)) continue;
    for (const uint32_t corner : corners) {
      if (!numbers[corner]) {
        numbers[corner] = static_cast<uint32_t>(ground.vertices.size());
        ground.vertices.push_back(mesh.vertices[corner]);
      }
      ground.triangles.push_back(*numbers[corner]);
    }
  }
  return ground;
}

void addSkirts(TileMesh& ground, double depth) {
  std::vector<std::optional<uint32_t>> below(ground.vertices.size());
  const auto under = [&](uint32_t corner) {
    if (!below[corner]) {
      below[corner] = static_cast<uint32_t>(ground.vertices.size());
      TileMesh::Vertex foot = ground.vertices[corner];
      foot.height -= static_cast<float>(depth);
      ground.vertices.push_back(foot);
    }
    return *below[corner];
  };
  // The ground lies to the left of its edges.
  for (size_t i = 0, end = ground.triangles.size(); i < end; ++i) {
    const uint32_t a = ground.triangles[i];
    const uint32_t b = ground.triangles[i % 3 == 2 ? i - 2 : i + 1];
    if (!onOneSide(ground.vertices[a], ground.vertices[b])) continue;
    const uint32_t wall[] = {b, a, under(a), b, under(a), under(b)};
    ground.triangles.insert(ground.triangles.end(), std::begin(wall), std::end(wall));
  }
}

GeographicBounds GroundTileset::groundIn(const GeographicTile& tile) const {
  const GeographicBounds whole = boundsOf(tile);
  return {std::max(whole.west, bounds_.west), std::max(whole.south, bounds_.south),
          std::min(whole.east, bounds_.east), std::min(whole.north, bounds_.north)};
}

GroundTileset::Node GroundTileset::overThoseBelow(const GeographicTile& tile) {
  const double none = std::numeric_limits<double>::infinity();
  Node node{{{"refine", "REPLACE"}}, none, -none};
  json children = json::array();
  for (const uint32_t y : {2 * tile.y, 2 * tile.y + 1}) {
    for (const uint32_t x : {2 * tile.x, 2 * tile.x + 1}) {
      const auto child = below_.find({x, y});
      if (child == below_.end()) continue;
      node.lowest = std::min(node.lowest, child->second.lowest);
      node.highest = std::max(node.highest, child->second.highest);
      adopt(children, std::move(child->second.tile));
      below_.erase(child);
    }
  }
  if (!children.empty()) node.tile["children"] = std::move(children);
  return node;
}

Result<std::vector<std::byte>> GroundTileset::add(const TileMesh& ground,
                                                  const GeographicTile& tile,
                                                  const TileErrors& errors,
                                                  const ImageFile* texture) {
  if (tile.level != level_) {
    below_ = std::exchange(nodes_, {});
    level_ = tile.level;
    error_ = errors.shown;
  }
  Node node = overThoseBelow(tile);
  const bool alone = !node.tile.contains("children");
  std::vector<std::byte> bytes;
  if (!ground.triangles.empty()) {
    Result<std::vector<std::byte>> glb = encodeGlb(meshFileOf(ground, tile, texture), {});
    if (!glb.ok()) return glb.status();
    bytes = std::move(*glb);
    // Triangles are flat where the Earth is round, by less than the error.
    for (const TileMesh::Vertex& v : ground.vertices) {
      node.lowest = std::min(node.lowest, v.height - errors.heights);
      node.highest = std::max(node.highest, v.height + errors.heights);
    }
    node.tile["content"]["uri"] = std::to_string(tile.level) + "/" + std::to_string(tile.x) + "/" +
                                  std::to_string(tile.y) + ".glb";
  }
  if (bytes.empty() && alone) return bytes;
  node.tile["geometricError"] = alone ? 0 : errors.shown;
  node.tile["boundingVolume"] = volumeOf(groundIn(tile), node.lowest, node.highest);
  nodes_.emplace(std::pair(tile.x, tile.y), std::move(node));
  return bytes;
}

json GroundTileset::document() const {
  json children = json::array();
  double lowest = 0, highest = 0;
  for (const auto& item : nodes_) {
    const Node& node = item.second;
    lowest = children.empty() ? node.lowest : std::min(lowest, node.lowest);
    highest = children.empty() ? node.highest : std::max(highest, node.highest);
    adopt(children, node.tile);
  }
  // The root has no mesh. Until all of the ground is smaller than the error that a viewer allows,
  // it has to show those below.
  const double error = std::max(extentOf(bounds_), 2 * error_);
  json root{{"boundingVolume", volumeOf(bounds_, lowest, highest)},
            {"geometricError", error},
            {"refine", "REPLACE"}};
  if (!children.empty()) root["children"] = std::move(children);
  return {{"asset", {{"version", "1.1"}, {"generator", "Tetrakis"}}},
          {"geometricError", error},
          {"root", root}};
}

}  // namespace tetrakis::tools
