// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/decoded_maps.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/meshes/surface_file.hpp"
#include "apps/tools/report/object_mesh.hpp"

namespace tetrakis::tools {

namespace {

/// Whether a texture lies on the object as its texture does: on triangles, or on the same patches.
/// Normals there would count from texture coordinates that nobody knows.
bool liesOn(const tks_info& info, const tks_component& one) {
  if (one.kind != TKS_COMPONENT_TEXTURE) return false;
  if (info.object_triangles > 0) return one.domain == TKS_DOMAIN_PLANE;
  return hasAtlas(info) && one.domain == TKS_DOMAIN_FOREST && one.width == info.texture_width &&
         one.height == info.texture_height &&
         one.name != std::string_view(kMapNames[static_cast<size_t>(MapKind::kNormal)]);
}

}  // namespace

Result<DecodedMaps> DecodedMaps::of(const OpenStream& stream, uint64_t copies) {
  DecodedMaps maps;
  const tks_info& info = stream.decoder.info();
  if (!isObject(info)) return maps;
  maps.material_ = materialOf(info.material);
  maps.is_lit_ = *info.material != '\0';
  for (uint32_t number = 0; number < info.components; ++number) {
    const tks_component one = *stream.decoder.component(number);
    const auto name = std::find(kMapNames.begin(), kMapNames.end(), std::string_view(one.name));
    if (one.is_taken || name == kMapNames.end() || !liesOn(info, one)) continue;
    const auto kind = static_cast<MapKind>(name - kMapNames.begin());
    if (Status status = maps.take(stream, number, kind, copies); !status.ok()) return status;
    if (!maps.images_[static_cast<size_t>(kind)]) dropFactorsOf(kind, maps.material_.factors);
  }
  return maps;
}

/// An exact map may take no bytes at all.
Status DecodedMaps::take(const OpenStream& stream, uint32_t component, MapKind kind,
                         uint64_t copies) {
  Result<Decoder> decoder = openAgain(stream);
  if (!decoder) return decoder.status();
  if (Status status = decoder->choose(component); !status.ok()) return status;
  const tks_info& info = decoder->info();
  const bool is_whole = info.lossless != 0 && info.available_bytes >= info.stream_bytes;
  if (decoder->component(component)->available_bytes == 0 && !is_whole) return {};
  for (const std::optional<ImageFile>& held : images_) copies += held ? held->data.size() : 0;
  Result<ImageFile> image = decodeImage(*decoder, {}, copies);
  if (!image.ok()) return image.status();
  if (hasAtlas(info)) image = atlasOf(info).pictureOf(*image);
  images_[static_cast<size_t>(kind)] = withoutAlpha(*image);
  return {};
}

MeshMaps DecodedMaps::forMesh() const {
  MeshMaps maps;
  for (size_t kind = 0; kind < kMapKinds; ++kind)
    if (images_[kind]) maps.images[kind] = &*images_[kind];
  maps.material = material_;
  maps.is_lit = is_lit_;
  return maps;
}

std::string unwrittenNote(const std::string& name, const MeshMaps& maps) {
  const std::string format = formatOf(name, "");
  if (maps.hasImages() && format == "ply")
    return "a .ply file has no place for maps: --component takes each out";
  if (maps.at(MapKind::kOcclusion) != nullptr && format == "obj")
    return "an .obj file has no place for the map of occlusion: --component takes it out";
  return "";
}

}  // namespace tetrakis::tools
