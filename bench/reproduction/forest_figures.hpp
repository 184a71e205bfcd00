// SPDX-License-Identifier: Apache-2.0
// What figures 3.3, 4.8, 4.9 and 4.10 of the thesis are drawn from.
#pragma once

#include <string>
#include <vector>

#include "bench/harness/results.hpp"

namespace tetrakis::bench {

/// Counts of the four solids, their layouts, and how their sides are glued.
void countSolids(std::vector<ResultRow>& rows);
/// Fig. 4.8b: the vertices that each hemisphere of the octahedron stores.
void listStored(std::vector<ResultRow>& rows);
/// Fig. 4.10: differences of codes between patches in a row and column, and paths round the cube.
void listPaths(std::vector<ResultRow>& rows);
/// folder/solid_NAME.csv of each solid: triangles of its meshes, on the solid, on the sphere, and
/// of a terrain on the sphere.
Status writeMeshes(const std::string& folder);

}  // namespace tetrakis::bench
