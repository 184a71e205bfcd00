// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/meshes/surface_maps.hpp"

#include <algorithm>
#include <utility>

#include "apps/tools/files/meshes/mesh_writers.hpp"
#include "apps/tools/files/meshes/surface_file.hpp"
#include "apps/tools/files/meshes/surface_texture.hpp"

namespace tetrakis::tools {
namespace {

/// A map, or the reason why there is none.
struct FoundMap {
  std::optional<ImageFile> image{};
  std::string reason{};
};

/// RGB that lacks nothing but colour.
bool isGrey(const ImageFile& image) {
  for (size_t at = 0; at < image.data.size(); at += image.channels)
    if (image.data[at] != image.data[at + 1] || image.data[at] != image.data[at + 2]) return false;
  return true;
}

/// What reads the maps of one file.
class MapReader {
 public:
  MapReader(const MeshImport& mesh, const std::string& mesh_path)
      : mesh_(mesh), mesh_path_(mesh_path) {}

  bool has(MapSlot slot) const { return !textureOf(slot).path.empty(); }
  bool has(MapKind kind) const {
    switch (kind) {
      case MapKind::kNormal:
        return has(MapSlot::kNormal) || has(MapSlot::kBump);
      case MapKind::kMetallicRoughness:
        return has(MapSlot::kMetallicRoughness) || has(MapSlot::kRoughness) ||
               has(MapSlot::kMetallic);
      case MapKind::kOcclusion:
        return has(MapSlot::kOcclusion);
      case MapKind::kEmissive:
        break;
    }
    return has(MapSlot::kEmissive);
  }
  FoundMap read(MapKind kind) const {
    switch (kind) {
      case MapKind::kNormal:
        return normals();
      case MapKind::kMetallicRoughness:
        return metallicRoughness();
      case MapKind::kOcclusion:
        return occlusion();
      case MapKind::kEmissive:
        break;
    }
    return read(MapSlot::kEmissive);
  }

  /// One picture holds occlusion, roughness and metalness.
  bool sharesOcclusion() const {
    return has(MapSlot::kOcclusion) && faultOf(MapSlot::kOcclusion) == MapFault::kNone &&
           textureOf(MapSlot::kOcclusion).path == textureOf(MapSlot::kMetallicRoughness).path;
  }

 private:
  const ImportedTexture& textureOf(MapSlot slot) const {
    return mesh_.maps[static_cast<size_t>(slot)];
  }
  MapFault faultOf(MapSlot slot) const { return mesh_.facts.map_faults[static_cast<size_t>(slot)]; }

  /// RGB.
  FoundMap read(MapSlot slot) const {
    if (mesh_.texcoords.empty()) return {{}, "the mesh has no texture coordinates"};
    if (faultOf(slot) == MapFault::kOtherTexcoords)
      return {{}, "it lies on other texture coordinates"};
    if (faultOf(slot) == MapFault::kOtherTransform)
      return {{}, "the material moves it in a way of its own"};
    if (faultOf(slot) == MapFault::kSeveralLooks)
      return {{}, "the parts have several textures or colours"};
    FoundTexture found = readMap(textureOf(slot), mesh_path_, "its file");
    if (found.image) found.image = withoutAlpha(*found.image);
    return {std::move(found.image), std::move(found.remark)};
  }

  /// Programs write normals under the name of bumps, too.
  FoundMap normals() const {
    const bool is_bump = !has(MapSlot::kNormal);
    FoundMap map = read(is_bump ? MapSlot::kBump : MapSlot::kNormal);
    if (map.image && is_bump && isGrey(*map.image))
      return {{}, "it holds heights of bumps, which are no normals"};
    return map;
  }

  FoundMap occlusion() const {
    FoundMap map = read(MapSlot::kOcclusion);
    if (map.image) map.image = channelOf(*map.image, 0);
    return map;
  }

  /// Red says nothing, and is white, unless it holds occlusion.
  FoundMap metallicRoughness() const {
    if (!has(MapSlot::kMetallicRoughness)) return joined();
    FoundMap map = read(MapSlot::kMetallicRoughness);
    if (!map.image || sharesOcclusion()) return map;
    for (size_t at = 0; at < map.image->data.size(); at += 3) map.image->data[at] = kWhite;
    return map;
  }

  /// Of one picture for each. Where one is missing its factor counts alone.
  FoundMap joined() const {
    FoundMap rough = has(MapSlot::kRoughness) ? read(MapSlot::kRoughness) : FoundMap{},
             metal = has(MapSlot::kMetallic) ? read(MapSlot::kMetallic) : FoundMap{};
    if (!rough.image && !metal.image)
      return {{}, rough.reason.empty() ? metal.reason : rough.reason};
    const ImageFile& one = rough.image ? *rough.image : *metal.image;
    if (metal.image && (metal.image->width != one.width || metal.image->height != one.height))
      return {{}, "its roughness and metalness have pictures of different sizes"};
    FoundMap map{ImageFile{one.width, one.height, 3, TKS_U8, {}}, {}};
    map.image->data.assign(one.data.size(), kWhite);
    for (size_t at = 0; at < one.data.size(); at += 3) {
      if (rough.image) map.image->data[at + 1] = rough.image->data[at];
      if (metal.image) map.image->data[at + 2] = metal.image->data[at];
    }
    return map;
  }

  static constexpr std::byte kWhite{255};
  const MeshImport& mesh_;
  const std::string& mesh_path_;
};

/// Whether all texels are alike.
bool isEven(const ImageFile& image) {
  for (size_t at = image.channels; at < image.data.size(); ++at)
    if (image.data[at] != image.data[at - image.channels]) return false;
  return true;
}

/// Puts an even map into its factors, which say as much in fewer bytes: streams could not tell it
/// from a map of which nothing has come. Of normals and occlusion there are none.
std::string evenMap(MapKind kind, const ImageFile& image, MaterialFactors& factors) {
  const auto value = [&](size_t channel) {
    return std::to_integer<int>(image.data[channel]) / 255.0;
  };
  constexpr size_t kGreen = 1, kBlue = 2;
  if (kind == MapKind::kMetallicRoughness) {
    factors.roughness *= value(kGreen);
    factors.metallic *= value(kBlue);
  } else if (kind == MapKind::kEmissive) {
    for (size_t axis = 0; axis < 3; ++axis) factors.emissive[axis] *= lightOf(value(axis));
  } else {
    return "it is the same all over";
  }
  return "it is the same all over, and becomes factors";
}

/// Other formats than glTF have factors of their maps that nobody fills in: 0 beside a map is 1.
MaterialFactors factorsOf(const MeshImport& mesh, const MapReader& reader) {
  MaterialFactors factors = mesh.facts.factors;
  if (mesh.facts.y_is_up) return factors;
  if (reader.has(MapSlot::kMetallic) && factors.metallic == 0) factors.metallic = 1;
  if (reader.has(MapSlot::kRoughness) && factors.roughness == 0) factors.roughness = 1;
  if (reader.has(MapSlot::kEmissive) && factors.emissive == std::array<double, 3>{})
    factors.emissive = {1, 1, 1};
  return factors;
}

}  // namespace

bool SurfaceMaps::has(MapKind kind) const {
  return std::any_of(taken.begin(), taken.end(),
                     [kind](const SurfaceMap& map) { return map.kind == kind; });
}

SurfaceMaps findMaps(const MeshImport& mesh, const std::string& mesh_path,
                     const std::vector<std::string>& wanted) {
  const MapReader reader(mesh, mesh_path);
  SurfaceMaps maps;
  maps.material.factors = factorsOf(mesh, reader);
  for (size_t i = 0; i < kMapKinds; ++i) {
    const auto kind = static_cast<MapKind>(i);
    if (!reader.has(kind)) continue;
    const bool is_wanted = std::find(wanted.begin(), wanted.end(), kMapNames[i]) != wanted.end();
    if (is_wanted && kind == MapKind::kOcclusion && reader.sharesOcclusion() &&
        maps.has(MapKind::kMetallicRoughness)) {
      maps.material.occlusion_is_red = true;
      continue;
    }
    FoundMap map = is_wanted ? reader.read(kind) : FoundMap{{}, "--maps"};
    if (map.image && isEven(*map.image)) {
      maps.left_out.push_back(std::string(kMapNames[i]) + " (" +
                              evenMap(kind, *map.image, maps.material.factors) + ")");
      maps.has_even = true;
      continue;
    }
    if (map.image) {
      maps.taken.push_back({kind, std::move(*map.image)});
      continue;
    }
    maps.left_out.push_back(std::string(kMapNames[i]) + " (" + map.reason + ")");
    dropFactorsOf(kind, maps.material.factors);
  }
  return maps;
}

}  // namespace tetrakis::tools
