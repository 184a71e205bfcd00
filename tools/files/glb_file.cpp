// SPDX-License-Identifier: Apache-2.0
// Binary glTF 2.0 (ISO/IEC 12113): one JSON chunk that describes, one binary chunk that holds.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "tools/files/little_endian.hpp"
#include "tools/files/mesh_writers.hpp"
#include "tools/files/png.hpp"

namespace tetrakis::tools {
namespace {

using nlohmann::json;

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;
constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kClampToEdge = 33071;

/// An array of one. Braces would not do: compilers disagree on whether {value} is an array or a
/// copy.
json listOf(json value) {
  return json::array({std::move(value)});
}

/// The document and its binary chunk as they grow.
struct Glb {
  json document;
  LittleEndianBuffer binary;

  /// Appends a buffer view and returns its index. target 0: no vertex or index data.
  template <class T>
  size_t addView(std::span<const T> values, int target) {
    binary.padTo4('\0');
    json view{
        {"buffer", 0}, {"byteOffset", binary.bytes.size()}, {"byteLength", values.size_bytes()}};
    if (target != 0) view["target"] = target;
    binary.putAll(values);
    document["bufferViews"].push_back(view);
    return document["bufferViews"].size() - 1;
  }

  size_t addAccessor(json accessor) {
    document["accessors"].push_back(std::move(accessor));
    return document["accessors"].size() - 1;
  }

  size_t addVectors(std::span<const float> values, size_t dimension) {
    return addAccessor({{"bufferView", addView(values, kArrayBuffer)},
                        {"componentType", kFloat},
                        {"count", values.size() / dimension},
                        {"type", "VEC" + std::to_string(dimension)}});
  }
};

json boundsOf(const std::vector<float>& positions) {
  json low = json::array(), high = json::array();
  for (size_t axis = 0; axis < 3; ++axis) {
    float least = positions[axis], most = positions[axis];
    for (size_t i = axis; i < positions.size(); i += 3) {
      least = std::min(least, positions[i]);
      most = std::max(most, positions[i]);
    }
    low.push_back(least);
    high.push_back(most);
  }
  return {{"min", low}, {"max", high}};
}

ImageFile reducedTo8Bits(const ImageFile& image) {
  ImageFile reduced{image.width, image.height, image.channels, TKS_U8, {}};
  reduced.data.resize(image.data.size() / 2);
  for (size_t i = 0; i < reduced.data.size(); ++i) {
    uint16_t value;
    std::copy_n(&image.data[2 * i], 2, reinterpret_cast<std::byte*>(&value));
    reduced.data[i] = static_cast<std::byte>((value * 255U + 32767U) / 65535U);
  }
  return reduced;
}

struct EncodedTexture {
  const char* mime_type;
  std::vector<std::byte> bytes;
};

/// glTF takes 8-bit JPEG and PNG.
Result<EncodedTexture> encodeTexture(const ImageFile& image) {
  constexpr int kQuality = 90;
  if (auto jpeg = encodeJpeg(image, kQuality); jpeg.ok()) {
    return EncodedTexture{"image/jpeg", std::move(*jpeg)};
  }
  auto png = encodePng(image.sample == TKS_U8 ? image : reducedTo8Bits(image));
  if (!png.ok()) return png.status();
  return EncodedTexture{"image/png", std::move(*png)};
}

/// A photograph already holds its light: textured terrain is unlit (KHR_materials_unlit) in viewers
/// that can, and rough in others.
Status addMaterial(Glb& glb, const ImageFile* image) {
  json material{{"name", "terrain"},
                {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}};
  if (image) {
    const auto texture = encodeTexture(*image);
    if (!texture.ok()) return texture.status();
    const size_t view = glb.addView(std::span<const std::byte>(texture->bytes), 0);
    json& document = glb.document;
    document["images"] = listOf({{"bufferView", view}, {"mimeType", texture->mime_type}});
    document["samplers"] = listOf({{"magFilter", kLinear},
                                   {"minFilter", kLinearMipmapLinear},
                                   {"wrapS", kClampToEdge},
                                   {"wrapT", kClampToEdge}});
    document["textures"] = listOf({{"sampler", 0}, {"source", 0}});
    document["extensionsUsed"] = listOf("KHR_materials_unlit");
    material["extensions"] = {{"KHR_materials_unlit", json::object()}};
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    if (image->channels % 2 == 0) material["alphaMode"] = "MASK";
  }
  glb.document["materials"] = listOf(material);
  return {};
}

/// In 16 bits where they hold every index; 65535 itself is none (primitive restart).
size_t addTriangles(Glb& glb, const MeshFile& mesh) {
  constexpr size_t kMaxShortVertices = 65535;
  const bool small = mesh.positions.size() / 3 <= kMaxShortVertices;
  size_t view = 0;
  if (small) {
    const std::vector<uint16_t> indices(mesh.triangles.begin(), mesh.triangles.end());
    view = glb.addView(std::span(indices), kElementArrayBuffer);
  } else {
    view = glb.addView(std::span(mesh.triangles), kElementArrayBuffer);
  }
  return glb.addAccessor({{"bufferView", view},
                          {"componentType", small ? kUnsignedShort : kUnsignedInt},
                          {"count", mesh.triangles.size()},
                          {"type", "SCALAR"}});
}

void addGeometry(Glb& glb, const MeshFile& mesh) {
  json attributes;
  const size_t positions = glb.addVectors(mesh.positions, 3);
  glb.document["accessors"][positions].update(boundsOf(mesh.positions));
  attributes["POSITION"] = positions;
  attributes["NORMAL"] = glb.addVectors(smoothNormals(mesh), 3);
  if (!mesh.texcoords.empty()) attributes["TEXCOORD_0"] = glb.addVectors(mesh.texcoords, 2);
  const size_t triangles = addTriangles(glb, mesh);
  json primitive{{"attributes", attributes}, {"indices", triangles}, {"material", 0}};
  glb.document["meshes"] = listOf({{"primitives", listOf(primitive)}});
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

Result<std::vector<std::byte>> encodeGlb(const MeshFile& mesh) {
  Glb glb;
  glb.document = {{"asset", {{"version", "2.0"}, {"generator", "Tetrakis"}}},
                  {"scene", 0},
                  {"scenes", listOf({{"nodes", listOf(0)}})},
                  {"nodes", listOf({{"mesh", 0}})}};
  addGeometry(glb, mesh);
  const Status status = addMaterial(glb, mesh.texture);
  if (!status.ok()) return status;
  glb.binary.padTo4('\0');
  glb.document["buffers"] = listOf({{"byteLength", glb.binary.bytes.size()}});
  return assemble(glb);
}

}  // namespace tetrakis::tools
