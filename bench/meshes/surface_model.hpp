// SPDX-License-Identifier: Apache-2.0
// SurfaceModel is a triangle mesh that codings are measured against, with its texture if it has
// one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/tools/report/painted_mesh.hpp"
#include "codec/remesh/triangle_tree.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// Stays where it is: its tree points to its mesh.
struct SurfaceModel {
  SurfaceModel(std::string of, tools::PaintedMesh mesh);
  SurfaceModel(const SurfaceModel&) = delete;
  SurfaceModel& operator=(const SurfaceModel&) = delete;

  const TriangleMesh& mesh() const { return painted.mesh; }
  bool hasTexture() const { return painted.image.has_value(); }

  std::string name;            ///< of the file, without its extension
  tools::PaintedMesh painted;  ///< each place once; no triangle of fewer than three points
  TriangleTree tree;
  double diagonal;
};

/// Errors of readSurface(); TKS_USAGE: no triangle has three points.
Result<std::unique_ptr<SurfaceModel>> readSurfaceModel(const std::string& path);

/// Files, and the meshes of folders and of those below, by name.
std::vector<std::string> surfaceFiles(const std::vector<std::string>& paths);

/// The unit of errors: 1e-4 of the diagonal of the model's box.
inline double inUnits(const SurfaceModel& model, double distance) {
  return 1e4 * distance / model.diagonal;
}

/// The larger of the two RMS distances, in these units. places: of either surface.
double errorOf(const SurfaceModel& model, const TriangleMesh& other);

}  // namespace tetrakis::bench
