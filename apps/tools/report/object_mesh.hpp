// SPDX-License-Identifier: Apache-2.0
// objectMesh() makes a mesh file of an object, in the axes and the unit of the mesh that was
// encoded.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/report/patch_atlas.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// Whether an object has a texture on its patches.
inline bool hasAtlas(const tks_info& info) {
  return isObject(info) && info.has_texture != 0 && info.texture_domain == TKS_DOMAIN_FOREST &&
         info.texture_forest.patches == info.forest.patches;
}

/// What that texture is laid out by.
inline PatchAtlas atlasOf(const tks_info& info) {
  return {info.texture_forest.patches, info.texture_forest.depth};
}

/// Where the vertices lie on the picture of the texture, two numbers each, from (0, 0) at its top
/// left corner to (1, 1); of an object with an atlas on that. Empty where there is no texture.
std::vector<float> objectTexcoords(const tks_info& info, const ObjectMesh& mesh);

/// With at most max_triangles (0: every sample; or the mesh that the bytes themselves code).
/// Normals are those of the mesh, the same on both sides of a seam. The errors of
/// tks_decode_object.
Result<MeshFile> objectMesh(Decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles);

}  // namespace tetrakis::tools
