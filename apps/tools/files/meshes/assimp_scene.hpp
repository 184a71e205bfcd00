// SPDX-License-Identifier: Apache-2.0
// joinScene() joins the meshes of Assimp's scene in one mesh, and materialOf() tells what colours
// they have. Only the module of mesh formats (assimp_import.cpp) has these.
#pragma once

#include <assimp/material.h>

#include <string>

#include "apps/tools/files/meshes/mesh_import.hpp"

struct aiScene;

namespace tetrakis::tools {

/// A texture of a material.
struct SceneTexture {
  std::string path{};         ///< or "*N": image N of the scene; "": there is none
  unsigned texcoords = 0;     ///< which texture coordinates place it
  aiUVTransform transform{};  ///< how they are moved, turned or scaled before
};

/// What the surface's own colour is, and what else is known of it.
struct SceneMaterial {
  SceneTexture texture{};
  std::array<SceneTexture, kMapSlots> maps{};
  std::array<double, 4> colour{1, 1, 1, 1};
  MaterialFactors factors{};

  /// The one that says how textures lie: of the colour, or the first map; null: there is none.
  const SceneTexture* leading() const;
  bool hasSameMaps(const SceneMaterial& other) const;
};
/// is_gltf: factors that are not said have glTF's usual values, else those of matt surfaces.
SceneMaterial materialOf(const aiMaterial& material, bool is_gltf);

bool isSame(const aiUVTransform& a, const aiUVTransform& b);

/// Fills all of `mesh` but what tells of the file: triangles in the order of the scene's nodes,
/// from the root down, with their orientation under mirrors kept. Polygons must be triangles
/// already. Sets `failure` where there are no triangles or too many, or coordinates are no numbers.
void joinScene(const aiScene& scene, MeshImport& mesh);

}  // namespace tetrakis::tools
