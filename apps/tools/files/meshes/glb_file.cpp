// SPDX-License-Identifier: Apache-2.0
// Binary glTF 2.0 (ISO/IEC 12113): one JSON chunk that describes, one binary chunk that holds.
#include <array>
#include <limits>
#include <optional>

#include "apps/tools/files/meshes/glb_document.hpp"
#include "apps/tools/files/meshes/mesh_writers.hpp"

namespace tetrakis::tools {
namespace {

using nlohmann::json;

/// A photograph already holds its light: textured terrain is unlit (KHR_materials_unlit) in viewers
/// that can, and rough in others. What has maps is lit by them.
Status addMaterial(Glb& glb, const MeshFile& mesh, MeshTexture format) {
  const ImageFile* image = mesh.texture;
  json material{{"name", "terrain"},
                {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}};
  std::optional<ImageFile> picture;
  if (image && image->hasFurtherColour()) image = &picture.emplace(withoutFurtherColour(*image));
  if (image) {
    const Result<size_t> texture = addTexture(glb, *image, mesh.texcoords, format);
    if (!texture.ok()) return texture.status();
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", *texture}};
    if (image->hasAlpha()) material["alphaMode"] = "MASK";
  }
  if (!mesh.maps.none()) {
    if (Status status = addMaps(glb, mesh, format, material); !status.ok()) return status;
  } else if (image) {
    glb.useExtension("KHR_materials_unlit", false);
    material["extensions"] = {{"KHR_materials_unlit", json::object()}};
  }
  glb.document["materials"] = listOf(material);
  return {};
}

/// Header: magic, version 2, length of everything. Chunks: length, type, content padded to four.
Result<std::vector<std::byte>> assemble(const Glb& glb) {
  LittleEndianBuffer text;
  text.putText(glb.document.dump());
  text.padTo4(' ');
  const size_t length = 12 + 8 + text.bytes.size() + 8 + glb.binary.bytes.size();
  if (length > std::numeric_limits<uint32_t>::max()) {
    return Status(TKS_LIMIT, "a .glb file ends at 4 GiB: ask for fewer triangles, or write a .ply");
  }
  LittleEndianBuffer file;
  file.bytes.reserve(length);
  file.putText("glTF");
  file.put(uint32_t{2});
  file.put(static_cast<uint32_t>(length));
  file.put(static_cast<uint32_t>(text.bytes.size()));
  file.putText("JSON");
  file.putAll(std::span<const std::byte>(text.bytes));
  file.put(static_cast<uint32_t>(glb.binary.bytes.size()));
  file.putText(std::string_view("BIN\0", 4));
  file.putAll(std::span<const std::byte>(glb.binary.bytes));
  return std::move(file.bytes);
}

}  // namespace

Result<std::vector<std::byte>> encodeGlb(const MeshFile& mesh, const MeshOptions& options) {
  Glb glb;
  glb.document = {{"asset", {{"version", "2.0"}, {"generator", "Tetrakis"}}},
                  {"scene", 0},
                  {"scenes", listOf({{"nodes", listOf(0)}})},
                  {"nodes", listOf({{"mesh", 0}})},
                  {"buffers", listOf(json::object())}};
  if (mesh.origin != std::array<double, 3>{}) glb.document["nodes"][0]["translation"] = mesh.origin;
  Status status = addGeometry(glb, mesh, options.compression);
  if (status.ok()) status = addMaterial(glb, mesh, options.texture);
  if (!status.ok()) return status;
  glb.binary.padTo4('\0');
  glb.document["buffers"][0]["byteLength"] = glb.binary.bytes.size();
  return assemble(glb);
}

}  // namespace tetrakis::tools
