// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/globe_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"
#include "apps/tools/files/place/texture_place.hpp"
#include "apps/tools/report/surface_normals.hpp"

namespace tetrakis::tools {

Result<tks_globe> globeOf(const tks_info& info, double exaggeration) {
  const GridUnit unit = gridUnitOf(info.geo_keys, info.crs);
  if (unit.degrees == 0 && *info.crs)
    return Status(TKS_USAGE, "the coordinates of the heights are no angles: they lie on no globe");
  const double minor = unit.ellipsoid.semi_major * (1 - unit.ellipsoid.flattening);
  return tks_globe{sizeof(tks_globe), unit.ellipsoid.semi_major, minor, unit.degrees, exaggeration};
}

namespace {

using Vector = std::array<double, 3>;

/// From x to longitude 0 and z north to the axes of glTF.
Vector upright(std::span<const double> p) {
  return {p[0], p[2], -p[1]};
}

/// Turned likewise, of vertices at one place the same.
std::vector<float> uprightNormals(const GlobeMesh& mesh) {
  std::vector<float> normals = joinedNormals(mesh.positions(), mesh.triangles());
  for (size_t i = 0; i < normals.size(); i += 3) {
    const float north = normals[i + 2];
    normals[i + 2] = -normals[i + 1];
    normals[i + 1] = north;
  }
  return normals;
}

/// Where the texture lies under a place of the heights' raster, in texels from its outer corner.
class TexelUnder {
 public:
  explicit TexelUnder(const tks_info& info)
      : info_(info), place_(PlacedRaster::heightsOf(info), PlacedRaster::textureOf(info)) {}

  /// Of a raster without a place it covers all; a patch of a forest, from corner to corner.
  std::array<double, 2> at(double column, double row) const {
    if (info_.domain == TKS_DOMAIN_FOREST) return onForest(column - 0.5, row - 0.5);
    if (info_.texture_has_geotransform) return place_.texelAt(column - 0.5, row - 0.5);
    return {column * info_.texture_width / info_.width, row * info_.texture_height / info_.height};
  }

 private:
  std::array<double, 2> onForest(double x, double y) const {
    const double scale = std::ldexp(
        1., static_cast<int>(info_.texture_forest.depth) - static_cast<int>(info_.forest.depth));
    const double patch = std::floor(y / info_.width);
    return {0.5 + scale * x, 0.5 + patch * info_.texture_width + scale * (y - patch * info_.width)};
  }

  const tks_info& info_;
  TexturePlace place_;
};

std::vector<float> textureCoordinates(const tks_info& info, const GlobeMesh& mesh) {
  const TexelUnder texel(info);
  const auto part = [](double at, double side) {
    return std::isfinite(at) ? static_cast<float>(std::clamp(at / side, 0., 1.)) : 0.f;
  };
  std::vector<float> coordinates;
  for (size_t i = 0; i < mesh.pixels().size(); i += 2) {
    const auto [x, y] = texel.at(mesh.pixels()[i], mesh.pixels()[i + 1]);
    coordinates.push_back(part(x, info.texture_width));
    coordinates.push_back(part(y, info.texture_height));
  }
  return coordinates;
}

}  // namespace

Result<MeshFile> globeMesh(Decoder& decoder, const GlobeRequest& request) {
  const tks_info& info = decoder.info();
  const Result<tks_globe> body = globeOf(info, request.exaggeration);
  if (!body.ok()) return body.status();
  const Result<GlobeMesh> mesh =
      request.coded ? decoder.codedGlobe(*body) : decoder.budgetGlobe(*body, request.max_triangles);
  if (!mesh.ok()) return mesh.status();
  MeshFile file;
  for (uint32_t v = 0; v < mesh->vertexCount(); ++v)
    for (const double part : upright(mesh->positions().subspan(size_t{3} * v, 3)))
      file.positions.push_back(static_cast<float>(part));
  file.triangles.assign(mesh->triangles().begin(), mesh->triangles().end());
  file.normals = uprightNormals(*mesh);
  if (!info.has_texture) return file;
  if (isGridOnCube(info) && info.texture_domain != TKS_DOMAIN_FOREST)
    layOnCube(info, *body, *mesh, file);
  else
    file.texcoords = textureCoordinates(info, *mesh);
  return file;
}

}  // namespace tetrakis::tools
