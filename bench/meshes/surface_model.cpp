// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/surface_model.hpp"

#include <filesystem>
#include <utility>

#include "apps/tools/files/meshes/surface_file.hpp"
#include "bench/harness/height_files.hpp"
#include "codec/remesh/mesh_distance.hpp"

namespace tetrakis::bench {
namespace {

namespace fs = std::filesystem;

/// Points of files are distinct already; triangles of fewer than three points say nothing.
tools::PaintedMesh paintedMesh(const tools::SurfaceFile& file) {
  tools::PaintedMesh out;
  out.mesh.points = file.points;
  const bool painted = file.texture && !file.texcoords.empty();
  for (size_t i = 0; i < file.triangles.size(); ++i) {
    const auto& t = file.triangles[i];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    out.mesh.triangles.push_back(t);
    for (size_t k = 0; painted && k < 3; ++k) out.texcoords.push_back(file.texcoords[3 * i + k]);
  }
  if (painted) out.image = tools::shownTexture(file);
  return out;
}

}  // namespace

SurfaceModel::SurfaceModel(std::string of, tools::PaintedMesh mesh)
    : name(std::move(of)),
      painted(std::move(mesh)),
      tree(painted.mesh),
      diagonal(remesh::diagonal(painted.mesh)) {}

Result<std::unique_ptr<SurfaceModel>> readSurfaceModel(const std::string& path) {
  const Result<tools::SurfaceFile> file = tools::readSurface(path);
  if (!file.ok()) return file.status();
  auto model = std::make_unique<SurfaceModel>(fs::path(path).stem().string(), paintedMesh(*file));
  if (!(model->diagonal > 0) || model->mesh().triangles.empty())
    return Status(TKS_USAGE, path + " has no triangle of three points");
  return model;
}

std::vector<std::string> surfaceFiles(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const fs::path& file : filesBelow(
             {path}, {}, [](const fs::path& found) { return tools::isMeshFile(found.string()); }))
      files.push_back(file.string());
  }
  return files;
}

double errorOf(const SurfaceModel& model, const TriangleMesh& other) {
  const TriangleTree tree(other);
  return inUnits(model, meshDistance(model.tree, tree).error);
}

}  // namespace tetrakis::bench
