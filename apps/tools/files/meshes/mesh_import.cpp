// SPDX-License-Identifier: Apache-2.0
// Loading the module of mesh formats, and the way of its result from one process to the other.
#include "apps/tools/files/meshes/mesh_import.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <span>
#include <system_error>
#include <type_traits>

#include "apps/tools/files/separate_process.hpp"

namespace tetrakis::tools {
namespace {

using Importer = void(const std::string&, MeshImport&);

/// Never unloaded.
Result<Importer*> loadImporter() {
  void* const module = dlopen("tetrakis_meshes.so", RTLD_LAZY | RTLD_LOCAL);
  auto* const importer =
      module ? reinterpret_cast<Importer*>(dlsym(module, "tetrakis_import_mesh")) : nullptr;
  if (importer) return importer;
  const char* const reason = dlerror();
  return Status(TKS_IO, std::string("the mesh formats cannot be loaded: ") +
                            (reason ? reason : "they are of another version"));
}

/// Calls visit() with every array of the mesh.
template <class Import, class Visit>
void forArrays(Import& mesh, Visit visit) {
  visit(mesh.failure);
  visit(mesh.name);
  visit(mesh.points);
  visit(mesh.triangles);
  visit(mesh.texcoords);
  const auto visit_texture = [&visit](auto& texture) {
    visit(texture.path);
    visit(texture.file);
  };
  visit_texture(mesh.texture);
  for (auto& map : mesh.maps) visit_texture(map);
  visit(mesh.looks);
  visit(mesh.runs);
  visit(mesh.corner_colours);
  if constexpr (!std::is_const_v<Import>) mesh.look_textures.resize(mesh.looks.size());
  for (auto& texture : mesh.look_textures) visit_texture(texture);
}

std::vector<std::byte> packed(const MeshImport& mesh) {
  std::vector<std::byte> bytes;
  const auto append = [&bytes](const auto* items, size_t count) {
    const std::span<const std::byte> added = std::as_bytes(std::span(items, count));
    bytes.insert(bytes.end(), added.begin(), added.end());
  };
  append(&mesh.facts, 1);
  forArrays(mesh, [&append](const auto& array) {
    const size_t count = array.size();
    append(&count, 1);
    append(array.data(), count);
  });
  return bytes;
}

/// False unless the bytes are those of packed().
bool unpack(std::span<const std::byte> bytes, MeshImport& mesh) {
  bool whole = true;
  const auto take = [&bytes, &whole](auto* items, size_t count) {
    const size_t item = sizeof(*items);
    whole = whole && count <= bytes.size() / item;
    if (!whole || count == 0) return;
    std::memcpy(items, bytes.data(), count * item);
    bytes = bytes.subspan(count * item);
  };
  take(&mesh.facts, 1);
  forArrays(mesh, [&](auto& array) {
    size_t count = 0;
    take(&count, 1);
    whole = whole && count <= bytes.size() / sizeof(array[0]);
    array.resize(whole ? count : 0);
    take(array.data(), array.size());
  });
  return whole && bytes.empty();
}

/// Assimp reads most formats at more than 2 MB/s.
uint32_t secondsFor(const std::string& path) {
  constexpr uint64_t kSeconds = 10, kBytesASecond = 200000, kMost = 7200;
  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(path, ignored);
  return static_cast<uint32_t>(
      ignored ? kSeconds : std::min<uint64_t>(kMost, kSeconds + bytes / kBytesASecond));
}

}  // namespace

Result<MeshImport> importMesh(const std::string& path) {
  static const Result<Importer*> importer = loadImporter();
  if (!importer.ok()) return importer.status();
  const Result<std::vector<std::byte>> bytes = inSeparateProcess(
      [&path] {
        MeshImport mesh;
        (*importer)(path, mesh);
        return packed(mesh);
      },
      secondsFor(path));
  if (!bytes.ok()) return bytes.status();
  MeshImport mesh;
  if (!unpack(*bytes, mesh)) return Status(TKS_USAGE, "it is damaged");
  if (!mesh.failure.empty())
    return Status(mesh.facts.too_large ? TKS_LIMIT : TKS_USAGE, mesh.failure);
  return mesh;
}

}  // namespace tetrakis::tools
