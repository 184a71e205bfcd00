// SPDX-License-Identifier: Apache-2.0
// The colour of a material of Assimp: glTF calls it base colour, the older formats diffuse colour.
#include <assimp/material.h>

#include "apps/tools/files/meshes/assimp_scene.hpp"

namespace tetrakis::tools {
namespace {

/// Whether the material says how to move texture coordinates before they are used.
bool isTransformed(const aiMaterial& material, aiTextureType type) {
  aiUVTransform transform;
  if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) != aiReturn_SUCCESS) return false;
  const aiUVTransform same;
  return !(transform.mTranslation == same.mTranslation && transform.mScaling == same.mScaling &&
           transform.mRotation == same.mRotation);
}

/// The grey that Assimp gives to what has no colour (of OBJ: no material library).
bool isMadeUp(const aiColor4D& colour) {
  constexpr float kGrey = 0.6F;
  return colour.r == kGrey && colour.g == kGrey && colour.b == kGrey;
}

}  // namespace

SceneMaterial materialOf(const aiMaterial& material) {
  SceneMaterial found;
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    aiString path;
    if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS || path.length == 0) continue;
    found.texture = path.C_Str();
    int channel = 0;
    if (material.Get(AI_MATKEY_UVWSRC(type, 0), channel) == aiReturn_SUCCESS && channel > 0)
      found.texcoords = static_cast<unsigned>(channel);
    found.transformed = isTransformed(material, type);
    break;
  }
  aiColor4D colour;
  if ((material.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
       material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS) &&
      !isMadeUp(colour))
    found.colour = {colour.r, colour.g, colour.b, colour.a};
  return found;
}

}  // namespace tetrakis::tools
