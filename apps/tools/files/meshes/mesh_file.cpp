// SPDX-License-Identifier: Apache-2.0
// Meshes on disk: what may be written, and PLY (Turk 1994).
#include <algorithm>
#include <cmath>
#include <span>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/little_endian.hpp"
#include "apps/tools/files/meshes/mesh_writers.hpp"

namespace tetrakis::tools {
namespace {

Status checkMesh(const MeshFile& mesh) {
  const size_t vertices = mesh.positions.size() / 3;
  const auto refuse = [](const char* what) { return Status(TKS_USAGE, what); };
  if (vertices == 0 || mesh.triangles.empty()) return refuse("a mesh file needs triangles");
  if (mesh.positions.size() % 3 != 0 || mesh.triangles.size() % 3 != 0) {
    return refuse("positions and triangles of a mesh come in threes");
  }
  if (!mesh.texcoords.empty() && mesh.texcoords.size() != 2 * vertices) {
    return refuse("a mesh has two texture coordinates for every vertex, or none");
  }
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
    return refuse("a mesh has a normal for every vertex, or none");
  }
  if ((mesh.texture || mesh.maps.hasImages()) && mesh.texcoords.empty()) {
    return refuse("a textured mesh needs texture coordinates");
  }
  const auto finite = [](float value) { return std::isfinite(value); };
  if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), finite) ||
      !std::all_of(mesh.texcoords.begin(), mesh.texcoords.end(), finite)) {
    return refuse("a coordinate of the mesh is not finite");
  }
  if (*std::max_element(mesh.triangles.begin(), mesh.triangles.end()) >= vertices) {
    return refuse("a triangle of the mesh names a vertex that does not exist");
  }
  return {};
}

}  // namespace

std::vector<std::byte> encodePly(const MeshFile& mesh) {
  const bool textured = !mesh.texcoords.empty();
  const size_t vertices = mesh.positions.size() / 3;
  LittleEndianBuffer file;
  file.putText("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices) +
               "\nproperty float x\nproperty float y\nproperty float z\n"
               "property float nx\nproperty float ny\nproperty float nz\n" +
               (textured ? "property float s\nproperty float t\n" : "") + "element face " +
               std::to_string(mesh.triangles.size() / 3) +
               "\nproperty list uchar int vertex_indices\nend_header\n");
  const std::vector<float> normals = normalsOf(mesh);
  for (size_t i = 0; i < vertices; ++i) {
    file.putAll(std::span(mesh.positions).subspan(3 * i, 3));
    file.putAll(std::span(normals).subspan(3 * i, 3));
    if (!textured) continue;
    file.put(mesh.texcoords[2 * i]);
    file.put(1 - mesh.texcoords[2 * i + 1]);
  }
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    file.put(uint8_t{3});
    file.putAll(std::span(mesh.triangles).subspan(i, 3));
  }
  return std::move(file.bytes);
}

Status checkMeshOptions(const std::string& path, const MeshOptions& options) {
  if (formatOf(path, "") == "glb" || options == MeshOptions()) return {};
  return {TKS_USAGE, "--compress and --mesh-texture are for meshes that end in .glb"};
}

Status writeMesh(const std::string& path, const MeshFile& mesh, const std::string& format,
                 const MeshOptions& options) {
  const Status sound = checkMesh(mesh);
  if (!sound.ok()) return sound;
  const std::string name = formatOf(path, format);
  if (name == "obj") return writeObj(path, mesh);
  if (name == "ply") return writeBytes(path, encodePly(mesh));
  if (name == "glb") {
    const auto glb = encodeGlb(mesh, options);
    return glb.ok() ? writeBytes(path, *glb) : glb.status();
  }
  return {TKS_USAGE,
          "cannot tell the format of " + quoted(path) + ": end the name in .glb, .obj or .ply"};
}

}  // namespace tetrakis::tools
