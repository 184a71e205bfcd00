// SPDX-License-Identifier: Apache-2.0
// OBJ (Wavefront, appendix B1), with its material library; maps of PBR by the names that Blender
// and Assimp know.
#include <array>
#include <charconv>
#include <filesystem>
#include <span>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/meshes/mesh_writers.hpp"
#include "apps/tools/files/pictures/png.hpp"
#include "apps/tools/files/text.hpp"

namespace tetrakis::tools {
namespace {

/// The shortest decimal that reads back as this float.
void appendFloat(std::string& text, float value) {
  std::array<char, 24> digits;
  text.append(digits.data(),
              std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

void appendRow(std::string& text, const char* keyword, std::span<const float> values) {
  text += keyword;
  for (const float value : values) {
    text += ' ';
    appendFloat(text, value);
  }
  text += '\n';
}

/// OBJ counts vertices from 1, and its texture coordinates from the bottom of the image.
std::string objText(const MeshFile& mesh, const std::string& library) {
  std::string text = library.empty() ? "" : "mtllib " + library + "\nusemtl terrain\n";
  for (size_t i = 0; i < mesh.positions.size(); i += 3) {
    appendRow(text, "v", std::span(mesh.positions).subspan(i, 3));
  }
  for (size_t i = 0; i < mesh.texcoords.size(); i += 2) {
    appendRow(text, "vt", std::array{mesh.texcoords[i], 1 - mesh.texcoords[i + 1]});
  }
  const std::vector<float> normals = normalsOf(mesh);
  for (size_t i = 0; i < normals.size(); i += 3) {
    appendRow(text, "vn", std::span(normals).subspan(i, 3));
  }
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    text += 'f';
    for (size_t corner = 0; corner < 3; ++corner) {
      const std::string index = std::to_string(uint64_t{mesh.triangles[i + corner]} + 1);
      text += ' ' + index + '/' + (mesh.texcoords.empty() ? "" : index) + '/' + index;
    }
    text += '\n';
  }
  return text;
}

Status writeText(const std::string& path, const std::string& text) {
  return writeBytes(path, std::as_bytes(std::span(text)));
}

/// Writes the pictures of a material beside the mesh, and its library.
class LibraryWriter {
 public:
  explicit LibraryWriter(const std::string& path) : path_(path) {}

  /// ending: what the picture is called behind the name of the mesh; keyword: "" for none.
  Status add(const ImageFile& image, const std::string& ending, const std::string& keyword) {
    std::filesystem::path file(path_);
    file.replace_extension();
    file += ending + ".png";
    const bool shows_all = image.white() == largestTexel(image.sample);
    const auto png = encodePng(shows_all ? image : reducedTo8Bits(image));
    if (!png.ok()) return png.status();
    text_ += keyword + " " + file.filename().string() + "\n";
    return writeBytes(file.string(), *png);
  }
  void say(const std::string& line) { text_ += line + "\n"; }

  /// The library, which comes last.
  Status write() {
    return writeText(std::filesystem::path(path_).replace_extension(".mtl").string(), text_);
  }

 private:
  const std::string& path_;
  std::string text_ = "newmtl terrain\nKd 1 1 1\n";
};

/// Of a map of three channels one, or grey.
ImageFile partOf(const ImageFile& map, size_t channel) {
  const ImageFile texels = map.sample == TKS_U8 ? map : reducedTo8Bits(map);
  return texels.channels < 3 ? texels : channelOf(texels, channel);
}

Status addMaps(const MeshMaps& maps, LibraryWriter& library) {
  constexpr size_t kGreen = 1, kBlue = 2;  // roughness and metalness, as glTF has them
  const MaterialFactors& factors = maps.material.factors;
  Status status;
  if (const ImageFile* const normal = maps.at(MapKind::kNormal))
    status = library.add(*normal, "_normal", "norm");
  if (const ImageFile* const surface = maps.at(MapKind::kMetallicRoughness); surface) {
    library.say("Pr " + shortest(factors.roughness) + "\nPm " + shortest(factors.metallic));
    if (status.ok()) status = library.add(partOf(*surface, kGreen), "_roughness", "map_Pr");
    if (status.ok()) status = library.add(partOf(*surface, kBlue), "_metallic", "map_Pm");
  }
  if (const ImageFile* const light = maps.at(MapKind::kEmissive); light && status.ok()) {
    const auto& [red, green, blue] = factors.emissive;
    library.say("Ke " + shortest(red) + " " + shortest(green) + " " + shortest(blue));
    status = library.add(*light, "_emissive", "map_Ke");
  }
  return status;
}

}  // namespace

Status writeObj(const std::string& path, const MeshFile& mesh) {
  if (!mesh.texture && !mesh.maps.hasImages()) return writeText(path, objText(mesh, ""));
  LibraryWriter library(path);
  Status status;
  if (mesh.texture) status = library.add(*mesh.texture, "", "map_Kd");
  if (status.ok() && mesh.texture && mesh.texture->hasAlpha())
    library.say("map_d " + std::filesystem::path(path).stem().string() + ".png");
  if (status.ok()) status = addMaps(mesh.maps, library);
  if (status.ok()) status = library.write();
  if (!status.ok()) return status;
  const std::filesystem::path name = std::filesystem::path(path).replace_extension(".mtl");
  return writeText(path, objText(mesh, name.filename().string()));
}

}  // namespace tetrakis::tools
