// SPDX-License-Identifier: Apache-2.0
// findMaps() reads what a material of a mesh file has beside its colour: maps of normals,
// metalness and roughness, occlusion and light, as glTF has them, whatever the file's format.
#pragma once

#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/meshes/material.hpp"
#include "apps/tools/files/meshes/mesh_import.hpp"

namespace tetrakis::tools {

/// Of 8 bits: grey of occlusion, RGB of others.
struct SurfaceMap {
  MapKind kind;
  ImageFile image;
};

struct SurfaceMaps {
  std::vector<SurfaceMap> taken;      ///< by their kinds, each once
  std::vector<std::string> left_out;  ///< names, each with the reason in brackets
  Material material;
  bool has_even = false;  ///< the factors say what a map said

  bool has(MapKind kind) const;
};

/// wanted: names of kMapNames. Others that the file has are left out.
SurfaceMaps findMaps(const MeshImport& mesh, const std::string& mesh_path,
                     const std::vector<std::string>& wanted);

}  // namespace tetrakis::tools
