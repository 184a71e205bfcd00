// SPDX-License-Identifier: Apache-2.0
// joinScene() joins the meshes of Assimp's scene in one mesh, and materialOf() tells what colours
// they have. Only the module of mesh formats (assimp_import.cpp) has these.
#pragma once

#include <string>

#include "apps/tools/files/meshes/mesh_import.hpp"

struct aiMaterial;
struct aiScene;

namespace tetrakis::tools {

/// What the surface's own colour is.
struct SceneMaterial {
  std::string texture{};     ///< a path, or "*N": image N of the scene; "": none
  unsigned texcoords = 0;    ///< which texture coordinates place it
  bool transformed = false;  ///< they are moved, turned or scaled before
  std::array<double, 4> colour{1, 1, 1, 1};
};
SceneMaterial materialOf(const aiMaterial& material);

/// Fills all of `mesh` but what tells of the file: triangles in the order of the scene's nodes,
/// from the root down, with their orientation under mirrors kept. Polygons must be triangles
/// already. Sets `failure` where there are no triangles or too many, or coordinates are no numbers.
void joinScene(const aiScene& scene, MeshImport& mesh);

}  // namespace tetrakis::tools
