// SPDX-License-Identifier: Apache-2.0
// The mesh inside a GLB: plain, KHR_draco_mesh_compression or EXT_meshopt_compression.
#include "apps/tools/compression/draco_mesh.hpp"
#include "apps/tools/compression/meshopt_mesh.hpp"
#include "apps/tools/files/meshes/glb_document.hpp"
#include "apps/tools/files/meshes/mesh_writers.hpp"

namespace tetrakis::tools {
namespace {

using nlohmann::json;

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kByte = 5120, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr size_t kMaxShortVertices = 65535;  // index 65535 itself is none (primitive restart)

json accessorOf(int component, size_t count, const char* type) {
  return {{"componentType", component}, {"count", count}, {"type", type}};
}

json positionAccessor(size_t count, const MeshBounds& bounds) {
  json accessor = accessorOf(kFloat, count, "VEC3");
  accessor["min"] = bounds.low;
  accessor["max"] = bounds.high;
  return accessor;
}

int indexType(size_t vertices) {
  return vertices <= kMaxShortVertices ? kUnsignedShort : kUnsignedInt;
}

/// An accessor of this view.
size_t addOver(Glb& glb, size_t view, json accessor) {
  accessor["bufferView"] = view;
  return glb.addAccessor(std::move(accessor));
}

size_t addTriangles(Glb& glb, const MeshFile& mesh) {
  const size_t vertices = mesh.positions.size() / 3;
  size_t view = 0;
  if (vertices <= kMaxShortVertices) {
    const std::vector<uint16_t> indices(mesh.triangles.begin(), mesh.triangles.end());
    view = glb.addView(std::span(indices), kElementArrayBuffer);
  } else {
    view = glb.addView(std::span(mesh.triangles), kElementArrayBuffer);
  }
  return addOver(glb, view, accessorOf(indexType(vertices), mesh.triangles.size(), "SCALAR"));
}

/// Arrays as they are.
json plainPrimitive(Glb& glb, const MeshArrays& mesh, const MeshFile& file) {
  const size_t vertices = mesh.positions.size() / 3;
  const auto add = [&glb](std::span<const float> values, json accessor) {
    return addOver(glb, glb.addView(values, kArrayBuffer), std::move(accessor));
  };
  json attributes;
  attributes["POSITION"] =
      add(mesh.positions, positionAccessor(vertices, meshBounds(mesh.positions)));
  attributes["NORMAL"] = add(mesh.normals, accessorOf(kFloat, vertices, "VEC3"));
  if (!mesh.texcoords.empty())
    attributes["TEXCOORD_0"] = add(mesh.texcoords, accessorOf(kFloat, vertices, "VEC2"));
  return {{"attributes", attributes}, {"indices", addTriangles(glb, file)}};
}

/// One view holds all; the accessors say what a decoder makes of it.
Result<json> dracoPrimitive(Glb& glb, const MeshArrays& mesh) {
  const auto coded = encodeDraco(mesh);
  if (!coded.ok()) return coded.status();
  json attributes, ids;
  attributes["POSITION"] = glb.addAccessor(positionAccessor(coded->vertices, coded->bounds));
  attributes["NORMAL"] = glb.addAccessor(accessorOf(kFloat, coded->vertices, "VEC3"));
  ids = {{"POSITION", coded->position}, {"NORMAL", coded->normal}};
  if (!mesh.texcoords.empty()) {
    attributes["TEXCOORD_0"] = glb.addAccessor(accessorOf(kFloat, coded->vertices, "VEC2"));
    ids["TEXCOORD_0"] = coded->texcoord;
  }
  const size_t indices =
      glb.addAccessor(accessorOf(indexType(coded->vertices), 3 * coded->triangles, "SCALAR"));
  const size_t view = glb.addView(std::span<const std::byte>(coded->bytes), 0);
  constexpr const char* kName = "KHR_draco_mesh_compression";
  glb.useExtension(kName, true);
  return json{{"attributes", attributes},
              {"indices", indices},
              {"extensions", {{kName, {{"bufferView", view}, {"attributes", ids}}}}}};
}

/// Buffer 1 is what decoders fill: a fallback without bytes.
class MeshoptWriter {
 public:
  explicit MeshoptWriter(Glb& glb) : glb_(glb) {}

  size_t add(const MeshoptStream& stream, int target, const char* filter, json accessor) {
    json coded{{"buffer", 0},
               {"byteOffset", glb_.addBytes(std::span<const std::byte>(stream.bytes))},
               {"byteLength", stream.bytes.size()},
               {"byteStride", stream.stride},
               {"count", stream.count},
               {"mode", target == kElementArrayBuffer ? "TRIANGLES" : "ATTRIBUTES"}};
    if (filter) coded["filter"] = filter;
    const size_t length = stream.count * stream.stride;
    json view{{"buffer", 1},
              {"byteOffset", decoded_},
              {"byteLength", length},
              {"target", target},
              {"extensions", {{"EXT_meshopt_compression", coded}}}};
    if (target == kArrayBuffer) view["byteStride"] = stream.stride;
    decoded_ += (length + 3) / 4 * 4;
    return addOver(glb_, glb_.addView(std::move(view)), std::move(accessor));
  }

  /// After all streams.
  void finish() {
    json fallback{{"byteLength", decoded_},
                  {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}};
    glb_.document["buffers"] = json::array({json::object(), fallback});
    glb_.useExtension("EXT_meshopt_compression", true);
    glb_.useExtension("KHR_mesh_quantization", true);  // normals of bytes
  }

 private:
  Glb& glb_;
  size_t decoded_ = 0;
};

json meshoptPrimitive(Glb& glb, const MeshArrays& mesh) {
  const MeshoptMesh coded = encodeMeshopt(mesh);
  const size_t vertices = coded.positions.count;
  MeshoptWriter writer(glb);
  json attributes, normal = accessorOf(kByte, vertices, "VEC3");
  normal["normalized"] = true;
  attributes["POSITION"] = writer.add(coded.positions, kArrayBuffer, "EXPONENTIAL",
                                      positionAccessor(vertices, coded.bounds));
  attributes["NORMAL"] = writer.add(coded.normals, kArrayBuffer, "OCTAHEDRAL", normal);
  if (!mesh.texcoords.empty()) {
    json texcoord = accessorOf(kUnsignedShort, vertices, "VEC2");
    texcoord["normalized"] = true;
    attributes["TEXCOORD_0"] = writer.add(coded.texcoords, kArrayBuffer, nullptr, texcoord);
  }
  const size_t indices =
      writer.add(coded.triangles, kElementArrayBuffer, nullptr,
                 accessorOf(indexType(vertices), coded.triangles.count, "SCALAR"));
  writer.finish();
  return {{"attributes", attributes}, {"indices", indices}};
}

}  // namespace

Status addGeometry(Glb& glb, const MeshFile& mesh, MeshCompression compression) {
  const std::vector<float> normals = normalsOf(mesh);
  const MeshArrays arrays{mesh.positions, normals, mesh.texcoords, mesh.triangles};
  json primitive;
  if (compression == MeshCompression::kDraco) {
    const Result<json> coded = dracoPrimitive(glb, arrays);
    if (!coded.ok()) return coded.status();
    primitive = *coded;
  } else if (compression == MeshCompression::kMeshopt) {
    primitive = meshoptPrimitive(glb, arrays);
  } else {
    primitive = plainPrimitive(glb, arrays, mesh);
  }
  primitive["material"] = 0;
  glb.document["meshes"] = listOf({{"primitives", listOf(primitive)}});
  return {};
}

}  // namespace tetrakis::tools
