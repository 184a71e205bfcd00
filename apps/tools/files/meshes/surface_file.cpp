// SPDX-License-Identifier: Apache-2.0
// What a file is, and what there is to say about the mesh that it holds.
#include "apps/tools/files/meshes/surface_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/meshes/mesh_import.hpp"
#include "apps/tools/files/meshes/surface_texture.hpp"
#include "apps/tools/files/meshes/texture_pages.hpp"

namespace tetrakis::tools {
namespace {

namespace fs = std::filesystem;

/// "3 parts are joined", "1 part is joined".
std::string counted(uint64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::vector<std::string> remarksOn(const MeshFacts& facts) {
  std::vector<std::string> remarks;
  if (facts.parts > 1) remarks.push_back(std::to_string(facts.parts) + " parts are joined");
  if (facts.other_maps > 0)
    remarks.push_back(counted(facts.other_maps, "part has other maps, which are left out",
                              "parts have other maps, which are left out"));
  if (facts.polygons > 0)
    remarks.push_back(counted(facts.polygons, "polygon is", "polygons are") +
                      " cut into triangles");
  if (facts.dropped > 0)
    remarks.push_back(counted(facts.dropped, "point or line is", "points or lines are") +
                      " left out");
  if (facts.unplaced > 0)
    remarks.push_back(counted(facts.unplaced, "texture coordinate is", "texture coordinates are") +
                      " not finite and become 0");
  if (facts.transformed) remarks.push_back("the material moves its texture, which is not done");
  return remarks;
}

std::string joined(const std::vector<std::string>& remarks) {
  std::string sentence;
  for (const std::string& remark : remarks) sentence += (sentence.empty() ? "" : ", ") + remark;
  return sentence;
}

/// Of what importMesh() gives; v counts from the top.
SurfaceFile surfaceOf(MeshImport& mesh, const std::string& path) {
  SurfaceFile surface;
  surface.points = std::move(mesh.points);
  surface.triangles = std::move(mesh.triangles);
  surface.texcoords = std::move(mesh.texcoords);
  for (std::array<float, 2>& at : surface.texcoords) at[1] = 1 - at[1];
  surface.base_colour = mesh.facts.base_colour;
  surface.name = mesh.name.empty() ? fs::path(path).stem().string() : mesh.name;
  surface.y_is_up = mesh.facts.y_is_up;
  surface.has_corner_colours = !mesh.corner_colours.empty();
  return surface;
}

/// The looks of all parts in one image, on texture coordinates that lie in it.
void takePages(TexturePages pages, SurfaceFile& surface, std::vector<std::string>& remarks) {
  surface.texture = std::move(pages.image);
  surface.texcoords = std::move(pages.texcoords);
  surface.base_colour = {1, 1, 1, 1};
  remarks.insert(remarks.end(), pages.remarks.begin(), pages.remarks.end());
}

}  // namespace

bool isMeshFile(const std::string& path) {
  static constexpr std::array<std::string_view, 5> kExtensions{"glb", "gltf", "obj", "ply", "stl"};
  if (std::find(kExtensions.begin(), kExtensions.end(), formatOf(path, "")) != kExtensions.end())
    return true;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  std::array<char, 4> first{};
  std::ifstream(path, std::ios::binary).read(first.data(), first.size());
  const std::string_view begin(first.data(), first.size());
  return begin == "glTF" || begin == "ply\n" || begin == "ply\r";
}

Result<SurfaceFile> readSurface(const std::string& path, std::string* note,
                                const SurfaceParts& parts) {
  if (!isMeshFile(path))
    return Status(TKS_USAGE, quoted(path) + " is no mesh: .glb, .gltf, .obj, .ply and .stl are");
  if (!std::ifstream(path).good() || !fs::is_regular_file(path))
    return Status(TKS_IO, quoted(path) + " cannot be read as a file");
  Result<MeshImport> mesh = importMesh(path);
  if (!mesh.ok()) {
    const Status failed = mesh.status();
    return Status(failed.code(), quoted(path) + " is not read as a mesh: " + failed.message());
  }
  std::vector<std::string> remarks = remarksOn(mesh->facts);
  SurfaceMaps maps = findMaps(*mesh, path, parts.maps);
  const bool has_looks = parts.texture && !mesh->looks.empty();
  TexturePages pages = has_looks ? pageTextures(*mesh, path) : TexturePages();
  SurfaceFile surface = surfaceOf(*mesh, path);
  surface.maps = std::move(maps);
  if (has_looks) {
    takePages(std::move(pages), surface, remarks);
  } else if (parts.texture && !surface.texcoords.empty()) {
    FoundTexture found = findTexture(*mesh, path);
    surface.texture = std::move(found.image);
    if (!found.remark.empty()) remarks.push_back(found.remark);
  }
  if (note) *note = joined(remarks);
  return surface;
}

}  // namespace tetrakis::tools
