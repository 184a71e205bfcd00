// SPDX-License-Identifier: Apache-2.0
// Normals of a mesh.
#include <cmath>

#include "apps/tools/files/meshes/mesh_writers.hpp"

namespace tetrakis::tools {

/// Sums of cross products, that is normals weighted by twice the area.
std::vector<float> smoothNormals(const MeshFile& mesh) {
  std::vector<double> sums(mesh.positions.size(), 0);
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const float* corner[3];
    double edge[2][3];
    for (size_t k = 0; k < 3; ++k) corner[k] = &mesh.positions[3 * size_t{mesh.triangles[i + k]}];
    for (size_t axis = 0; axis < 3; ++axis) {
      edge[0][axis] = double{corner[1][axis]} - corner[0][axis];
      edge[1][axis] = double{corner[2][axis]} - corner[0][axis];
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
      const double area = edge[0][next] * edge[1][last] - edge[0][last] * edge[1][next];
      for (size_t k = 0; k < 3; ++k) sums[3 * size_t{mesh.triangles[i + k]} + axis] += area;
    }
  }
  std::vector<float> normals(sums.size(), 0);
  for (size_t i = 0; i < sums.size(); i += 3) {
    const double length = std::hypot(sums[i], sums[i + 1], sums[i + 2]);
    if (!(length > 0) || !std::isfinite(length)) {
      normals[i + 1] = 1;
      continue;
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      normals[i + axis] = static_cast<float>(sums[i + axis] / length);
    }
  }
  return normals;
}

std::vector<float> normalsOf(const MeshFile& mesh) {
  return mesh.normals.empty() ? smoothNormals(mesh) : mesh.normals;
}

}  // namespace tetrakis::tools
