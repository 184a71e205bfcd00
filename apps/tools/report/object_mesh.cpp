// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/object_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/tools/report/surface_normals.hpp"

namespace tetrakis::tools {

std::vector<float> objectTexcoords(const tks_info& info, const ObjectMesh& mesh) {
  if (!hasAtlas(info)) return {mesh.texcoords().begin(), mesh.texcoords().end()};
  const PatchAtlas atlas = atlasOf(info);
  const double squares = std::ldexp(1.0, static_cast<int>(info.forest.depth));
  std::vector<float> coordinates;
  coordinates.reserve(mesh.pixels().size());
  for (size_t i = 0; i < mesh.pixels().size(); i += 2) {
    const double column = mesh.pixels()[i] - 0.5, row = mesh.pixels()[i + 1] - 0.5;
    const double patch = std::floor(row / (squares + 1));
    const auto place = atlas.at(static_cast<uint32_t>(patch), column / squares,
                                (row - patch * (squares + 1)) / squares);
    for (const double part : place) coordinates.push_back(static_cast<float>(part));
  }
  return coordinates;
}

Result<MeshFile> objectMesh(Decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles) {
  const Result<ObjectMesh> mesh = decoder.objectMesh(kind, max_triangles);
  if (!mesh.ok()) return mesh.status();
  MeshFile file;
  file.positions.reserve(mesh->positions().size());
  for (const double part : mesh->positions()) file.positions.push_back(static_cast<float>(part));
  file.triangles.assign(mesh->triangles().begin(), mesh->triangles().end());
  file.normals = joinedNormals(mesh->positions(), mesh->triangles());
  file.texcoords = objectTexcoords(decoder.info(), *mesh);
  return file;
}

}  // namespace tetrakis::tools
