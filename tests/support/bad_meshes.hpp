// SPDX-License-Identifier: Apache-2.0
// badMeshes() makes meshes as nobody wants them and everybody has them: soups, needles, fans of
// hundreds of triangles at one point, coordinates at the ends of doubles, texture coordinates that
// lie anywhere.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::made {

struct BadMesh {
  std::string name;
  TriangleMesh mesh;
  std::vector<float> texcoords;  ///< two a corner, or none
};

/// Others for each seed.
std::vector<BadMesh> badMeshes(uint32_t seed);

}  // namespace tetrakis::made
