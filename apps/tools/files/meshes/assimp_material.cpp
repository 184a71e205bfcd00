// SPDX-License-Identifier: Apache-2.0
// The colour and the maps of a material of Assimp: glTF calls the first base colour, the older
// formats diffuse colour.
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <utility>

#include "apps/tools/files/meshes/assimp_scene.hpp"

namespace tetrakis::tools {
namespace {

SceneTexture textureOf(const aiMaterial& material, aiTextureType type) {
  SceneTexture found;
  aiString path;
  if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS || path.length == 0) return found;
  found.path = path.C_Str();
  int channel = 0;
  if (material.Get(AI_MATKEY_UVWSRC(type, 0), channel) == aiReturn_SUCCESS && channel > 0)
    found.texcoords = static_cast<unsigned>(channel);
  aiUVTransform transform;
  if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS)
    found.transform = transform;
  return found;
}

/// The grey that Assimp gives to what has no colour (of OBJ: no material library).
bool isMadeUp(const aiColor4D& colour) {
  constexpr float kGrey = 0.6F;
  return colour.r == kGrey && colour.g == kGrey && colour.b == kGrey;
}

constexpr aiTextureType kPacked = aiTextureType_UNKNOWN;  ///< metalness and roughness, of glTF

constexpr std::pair<MapSlot, aiTextureType> kTypes[] = {
    {MapSlot::kNormal, aiTextureType_NORMALS},
    {MapSlot::kBump, aiTextureType_HEIGHT},
    {MapSlot::kMetallicRoughness, kPacked},
    {MapSlot::kRoughness, aiTextureType_DIFFUSE_ROUGHNESS},
    {MapSlot::kMetallic, aiTextureType_METALNESS},
    {MapSlot::kOcclusion, aiTextureType_LIGHTMAP},
    {MapSlot::kEmissive, aiTextureType_EMISSIVE}};

/// Assimp gives the map of metalness and roughness under both names as well.
void takeMaps(const aiMaterial& material, SceneMaterial& found) {
  const auto at = [&found](MapSlot slot) -> SceneTexture& {
    return found.maps[static_cast<size_t>(slot)];
  };
  for (const auto& [slot, type] : kTypes) at(slot) = textureOf(material, type);
  if (at(MapSlot::kMetallicRoughness).path.empty()) return;
  at(MapSlot::kRoughness) = at(MapSlot::kMetallic) = {};
}

void take(const aiMaterial& material, const char* key, unsigned type, double& factor) {
  float value = 0;
  if (material.Get(key, type, 0, value) == aiReturn_SUCCESS) factor = value;
}

/// A texture holds the light of such a surface: its factors are those of programs that cannot show
/// it so.
bool isUnlit(const aiMaterial& material) {
  int model = 0;
  return material.Get(AI_MATKEY_SHADING_MODEL, model) == aiReturn_SUCCESS &&
         model == aiShadingMode_Unlit;
}

void takeAlpha(const aiMaterial& material, MaterialFactors& factors) {
  aiString mode;
  if (material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS)
    factors.alpha_mode = alphaModeOf(mode.C_Str());
  if (factors.alpha_mode == AlphaMode::kMask)
    take(material, "$mat.gltf.alphaCutoff", 0, factors.alpha_cutoff);
}

MaterialFactors factorsOf(const aiMaterial& material, bool is_gltf) {
  MaterialFactors factors;
  if (is_gltf && isUnlit(material)) return factors;
  if (is_gltf) takeAlpha(material, factors);
  if (!is_gltf) factors.metallic = 0;
  take(material, "$mat.metallicFactor", 0, factors.metallic);
  take(material, "$mat.roughnessFactor", 0, factors.roughness);
  take(material, _AI_MATKEY_GLTF_SCALE_BASE, aiTextureType_NORMALS, factors.normal_scale);
  take(material, _AI_MATKEY_GLTF_STRENGTH_BASE, aiTextureType_LIGHTMAP, factors.occlusion_strength);
  aiColor4D emissive;
  if (material.Get(AI_MATKEY_COLOR_EMISSIVE, emissive) == aiReturn_SUCCESS)
    factors.emissive = {emissive.r, emissive.g, emissive.b};
  int two_sided = 0;
  if (material.Get(AI_MATKEY_TWOSIDED, two_sided) == aiReturn_SUCCESS)
    factors.is_double_sided = two_sided != 0;
  return factors;
}

}  // namespace

bool isSame(const aiUVTransform& a, const aiUVTransform& b) {
  return a.mTranslation == b.mTranslation && a.mScaling == b.mScaling && a.mRotation == b.mRotation;
}

const SceneTexture* SceneMaterial::leading() const {
  if (!texture.path.empty()) return &texture;
  const auto found = std::find_if(maps.begin(), maps.end(),
                                  [](const SceneTexture& map) { return !map.path.empty(); });
  return found == maps.end() ? nullptr : &*found;
}

bool SceneMaterial::hasSameMaps(const SceneMaterial& other) const {
  return std::equal(maps.begin(), maps.end(), other.maps.begin(),
                    [](const SceneTexture& a, const SceneTexture& b) { return a.path == b.path; });
}

SceneMaterial materialOf(const aiMaterial& material, bool is_gltf) {
  SceneMaterial found;
  found.texture = textureOf(material, aiTextureType_BASE_COLOR);
  if (found.texture.path.empty()) found.texture = textureOf(material, aiTextureType_DIFFUSE);
  takeMaps(material, found);
  found.factors = factorsOf(material, is_gltf);
  aiColor4D colour;
  if ((material.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
       material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS) &&
      !isMadeUp(colour))
    found.colour = {colour.r, colour.g, colour.b, colour.a};
  return found;
}

}  // namespace tetrakis::tools
