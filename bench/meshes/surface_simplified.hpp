// SPDX-License-Identifier: Apache-2.0
// What surfaces take today, before they are coded: meshes simplified by meshoptimizer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/tools/report/painted_mesh.hpp"
#include "bench/meshes/surface_model.hpp"

namespace tetrakis::bench {

/// As programs of others take meshes.
struct FloatMesh {
  std::vector<std::array<float, 3>> points;
  std::vector<std::array<float, 2>> texcoords;  ///< none, or one a point
  std::vector<uint32_t> corners;                ///< three a triangle
};

FloatMesh floatMesh(const TriangleMesh& mesh);
/// Points at seams of the texture come once for each pair of texture coordinates.
FloatMesh texturedFloatMesh(const tools::PaintedMesh& painted);
TriangleMesh triangleMesh(const FloatMesh& mesh);

/// Of at most `budget` triangles, whatever error that makes, unless seams do not let it; with the
/// points that triangles name.
FloatMesh simplified(const FloatMesh& mesh, uint32_t budget);

/// `sizes` numbers of triangles, from all or 120 000 down to 250, evenly spaced by logarithm.
std::vector<uint32_t> budgetsOf(const FloatMesh& mesh, uint32_t sizes);

}  // namespace tetrakis::bench
