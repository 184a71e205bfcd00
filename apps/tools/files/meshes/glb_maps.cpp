// SPDX-License-Identifier: Apache-2.0
// The maps of a material inside a GLB.
#include <optional>
#include <utility>

#include "apps/tools/files/meshes/glb_document.hpp"

namespace tetrakis::tools {
namespace {

using nlohmann::json;

/// Adds the textures of a mesh's maps.
class MapWriter {
 public:
  MapWriter(Glb& glb, const MeshFile& mesh, MeshTexture colours)
      : glb_(glb), mesh_(mesh), colours_(colours) {}

  /// Where the map is there, what names it in a material. Light is a colour; other maps hold values
  /// that shall not be mixed or rounded, as JPEG does.
  Result<std::optional<json>> add(MapKind kind) {
    const ImageFile* const image = mesh_.maps.at(kind);
    if (image == nullptr) return std::optional<json>();
    const MeshTexture format = kind == MapKind::kEmissive ? colours_ : MeshTexture::kPng;
    const Result<size_t> number = addTexture(glb_, *image, mesh_.texcoords, format);
    if (!number.ok()) return number.status();
    json map;
    map["index"] = *number;
    return std::optional<json>(std::move(map));
  }

 private:
  Glb& glb_;
  const MeshFile& mesh_;
  MeshTexture colours_;
};

/// A member that is left out where it is usual.
void sayUnusual(json& at, const char* name, double factor, double usual) {
  if (factor != usual) at[name] = factor;
}

}  // namespace

Status addMaps(Glb& glb, const MeshFile& mesh, MeshTexture format, json& material) {
  const Material& given = mesh.maps.material;
  MapWriter writer(glb, mesh, format);
  std::array<std::optional<json>, kMapKinds> maps;
  for (size_t kind = 0; kind < kMapKinds; ++kind) {
    Result<std::optional<json>> map = writer.add(static_cast<MapKind>(kind));
    if (!map.ok()) return map.status();
    maps[kind] = *std::move(map);
  }
  auto& [normal, surface, occlusion, light] = maps;
  if (normal) {
    sayUnusual(*normal, "scale", given.factors.normal_scale, 1);
    material["normalTexture"] = *normal;
  }
  if (surface) material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = *surface;
  if (!occlusion && surface && given.occlusion_is_red) occlusion = surface;
  if (occlusion) {
    sayUnusual(*occlusion, "strength", given.factors.occlusion_strength, 1);
    material["occlusionTexture"] = *occlusion;
  }
  if (light) material["emissiveTexture"] = *light;
  material["pbrMetallicRoughness"]["metallicFactor"] = given.factors.metallic;
  material["pbrMetallicRoughness"]["roughnessFactor"] = given.factors.roughness;
  if (given.factors.emissive != MaterialFactors().emissive)
    material["emissiveFactor"] = given.factors.emissive;
  if (given.factors.is_double_sided) material["doubleSided"] = true;
  if (given.factors.colour != MaterialFactors().colour)
    material["pbrMetallicRoughness"]["baseColorFactor"] = given.factors.colour;
  if (given.factors.alpha_mode != AlphaMode::kOpaque)
    material["alphaMode"] = nameOf(given.factors.alpha_mode);
  if (given.factors.alpha_mode == AlphaMode::kMask)
    sayUnusual(material, "alphaCutoff", given.factors.alpha_cutoff, 0.5);
  return {};
}

}  // namespace tetrakis::tools
