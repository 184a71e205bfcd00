// SPDX-License-Identifier: Apache-2.0
// The module of mesh formats: libassimp behind meshes/mesh_import.hpp. It cuts polygons into
// triangles, and is told to change nothing else.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <fstream>
#include <iterator>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/tools/files/meshes/assimp_scene.hpp"

namespace tetrakis::tools {
namespace {

/// The file, and what it is.
struct Source {
  std::string path, bytes;
  bool binary_gltf = bytes.starts_with("glTF");
  bool ply = bytes.starts_with("ply");
  bool json_gltf = path.ends_with(".gltf") || path.ends_with(".GLTF");

  explicit Source(const std::string& file) : path(file), bytes(contentOf(file)) {}
  static std::string contentOf(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
};

/// The JSON of glTF: of a .glb the first chunk.
std::string documentOf(const Source& source) {
  constexpr size_t kLength = 12, kHead = 20;
  if (!source.binary_gltf) return source.bytes;
  size_t length = 0;
  for (size_t i = 4; i-- > 0 && source.bytes.size() > kHead;)
    length = length << 8 | static_cast<unsigned char>(source.bytes[kLength + i]);
  return source.bytes.size() > kHead ? source.bytes.substr(kHead, length) : std::string();
}

/// The first extension that glTF readers need and Assimp lacks: it would read noise. "": none.
std::string unknownExtension(const Source& source) {
  const auto document = nlohmann::json::parse(documentOf(source), nullptr, false);
  if (!document.is_object() || !document.contains("extensionsRequired")) return {};
  for (const auto& name : document["extensionsRequired"]) {
    if (!name.is_string()) continue;
    const std::string text = name.get<std::string>();
    if (text.ends_with("_meshopt_compression") || text == "KHR_mesh_quantization") return text;
  }
  return {};
}

/// Whether the header of a PLY counts more items than the file has bytes: Assimp would make room
/// for them all.
bool claimsTooMuch(const Source& source) {
  std::istringstream header(source.bytes.substr(0, source.bytes.find("end_header")));
  for (std::string line; std::getline(header, line);) {
    std::istringstream words(line);
    std::string element, name;
    uint64_t count = 0;
    if (words >> element && element == "element" &&
        (!(words >> name >> count) || count > source.bytes.size()))
      return true;
  }
  return false;
}

/// "": Assimp may read it.
std::string objectionTo(const Source& source) {
  if (source.binary_gltf || source.json_gltf) {
    const std::string extension = unknownExtension(source);
    return extension.empty() ? "" : "it needs " + extension + ", which is not read";
  }
  return source.ply && claimsTooMuch(source) ? "it is cut short" : "";
}

/// Null if it cannot. Files without an extension that Assimp knows are read from memory.
const aiScene* sceneOf(const Source& source, Assimp::Importer& importer) {
  const size_t dot = source.path.rfind('.');
  const bool is_named =
      dot != source.path.npos && importer.IsExtensionSupported(source.path.substr(dot));
  if (is_named) return importer.ReadFile(source.path, 0);
  return importer.ReadFileFromMemory(source.bytes.data(), source.bytes.size(), 0,
                                     source.ply ? "ply" : "glb");
}

uint64_t polygonsOf(const aiScene& scene) {
  uint64_t polygons = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    polygons += static_cast<uint64_t>(
        std::count_if(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                      [](const aiFace& face) { return face.mNumIndices > 3; }));
  }
  return polygons;
}

/// Assimp catches everything itself, and has only words for it. Those that repeat the path say no
/// more than that it found nothing to read.
void refuse(const std::string& reason, const std::string& path, MeshImport& mesh) {
  if (reason.find("bad_alloc") != reason.npos) throw std::bad_alloc();
  const bool tells = !reason.empty() && reason.find(path) == reason.npos;
  mesh.failure = tells ? reason.substr(0, reason.find('\n')) : "it is damaged";
}

void importScene(const std::string& path, MeshImport& mesh) {
  Assimp::Importer importer;
  const aiScene* scene = nullptr;
  {
    const Source source(path);
    mesh.facts.y_is_up = source.binary_gltf || source.json_gltf;
    mesh.failure = objectionTo(source);
    if (!mesh.failure.empty()) return;
    scene = sceneOf(source, importer);
  }
  if (scene) mesh.facts.polygons = polygonsOf(*scene);
  if (scene && mesh.facts.polygons > 0) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene && scene->mRootNode)
    joinScene(*scene, mesh);
  else
    refuse(importer.GetErrorString(), path, mesh);
}

}  // namespace
}  // namespace tetrakis::tools

extern "C" __attribute__((visibility("default"))) void tetrakis_import_mesh(
    const std::string& path, tetrakis::tools::MeshImport& mesh) {
  tetrakis::tools::importScene(path, mesh);
}
