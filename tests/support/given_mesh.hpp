// SPDX-License-Identifier: Apache-2.0
// Meshes of triangles as the C interface takes them.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/remesh/triangle_mesh.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::test {

/// A mesh as the C interface takes it, which points into it.
struct GivenMesh {
  explicit GivenMesh(const TriangleMesh& mesh) {
    for (const Point& point : mesh.points)
      positions.insert(positions.end(), point.begin(), point.end());
    for (const Triangle& t : mesh.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
  }
  tks_triangle_mesh given() const {
    tks_triangle_mesh out{};
    out.size = sizeof out;
    out.vertex_count = static_cast<uint32_t>(positions.size() / 3);
    out.triangle_count = static_cast<uint32_t>(triangles.size() / 3);
    out.positions = positions.data();
    out.triangles = triangles.data();
    return out;
  }
  std::vector<double> positions;
  std::vector<uint32_t> triangles;
};

}  // namespace tetrakis::test
