// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/encode_maps.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "apps/tools/commands/notes.hpp"

namespace tetrakis::tools {
namespace {

size_t kindOf(const std::string& name) {
  return static_cast<size_t>(std::find(kMapNames.begin(), kMapNames.end(), name) -
                             kMapNames.begin());
}

std::string sizeOf(const ImageFile& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// A map that the user names has factors, too: those that show it as it is.
void showMap(size_t kind, MaterialFactors& factors) {
  if (static_cast<MapKind>(kind) == MapKind::kMetallicRoughness)
    factors.metallic = factors.roughness = 1;
  if (static_cast<MapKind>(kind) == MapKind::kEmissive) factors.emissive = {1, 1, 1};
}

/// Adds an image that the user names.
Status addNamed(const NamedFile& file, SurfaceFile& surface, bool quiet,
                std::vector<FurtherTexture>& textures) {
  std::string remark;
  Result<ImageFile> image = readImage(file.path, &remark);
  if (!image.ok()) return image.status();
  tellNote(remark, quiet);
  image->place = {};
  const size_t kind = kindOf(file.name);
  const auto same = std::find_if(textures.begin(), textures.end(),
                                 [&](const FurtherTexture& one) { return one.name == file.name; });
  if (kind < kMapKinds && same == textures.end()) showMap(kind, surface.maps.material.factors);
  if (kind < kMapKinds) image = withoutAlpha(*image);
  if (same != textures.end()) textures.erase(same);
  textures.push_back({file.name, std::move(*image)});
  return {};
}

}  // namespace

Result<std::vector<std::string>> wantedMaps(const std::string& text) {
  if (text == "all") return std::vector<std::string>(kMapNames.begin(), kMapNames.end());
  std::vector<std::string> names;
  if (text == "none") return names;
  std::istringstream words(text);
  for (std::string name; std::getline(words, name, ',');) names.push_back(name);
  const bool is_known = std::all_of(
      names.begin(), names.end(), [](const std::string& name) { return kindOf(name) < kMapKinds; });
  if (is_known && !names.empty()) return names;
  return Status(TKS_USAGE, "--maps takes all, none, or some of " +
                               joined({kMapNames.begin(), kMapNames.end()}) +
                               " with commas between them");
}

Result<std::vector<FurtherTexture>> furtherTextures(const EncodeArguments& arguments,
                                                    SurfaceFile& surface, bool quiet) {
  std::vector<FurtherTexture> textures;
  for (SurfaceMap& map : surface.maps.taken) {
    const auto kind = static_cast<size_t>(map.kind);
    textures.push_back({kMapNames[kind], std::move(map.image)});
  }
  surface.maps.taken.clear();
  const std::vector<NamedFile> also = namedFiles(arguments.also);
  for (const NamedFile& file : also)
    if (Status status = addNamed(file, surface, quiet, textures); !status.ok()) return status;
  std::vector<NamedFile> weighed;
  for (const FurtherTexture& one : textures) weighed.push_back({one.name, "", one.weight});
  if (Status status = takeWeights(arguments.weights_of_also, weighed); !status.ok()) return status;
  for (size_t i = 0; i < textures.size(); ++i) textures[i].weight = weighed[i].weight;
  return textures;
}

void leaveOutTextures(SurfaceFile& mesh, bool quiet) {
  const bool has_maps = !mesh.maps.taken.empty();
  mesh.maps.has_even = false;
  if (!mesh.texture && !has_maps) return;
  tellNote(std::string(!has_maps      ? "the texture is left out: it goes"
                       : mesh.texture ? "the texture and other maps are left out: they go"
                                      : "the maps are left out: they go") +
               " with --bytes alone",
           quiet);
  if (mesh.texture) std::fill_n(mesh.base_colour.begin(), 3, 1.0);
  mesh.texture.reset();
  for (const SurfaceMap& map : mesh.maps.taken) dropFactorsOf(map.kind, mesh.maps.material.factors);
  mesh.maps.taken.clear();
  mesh.maps.material.occlusion_is_red = false;
}

GivenMaps::GivenMaps(const std::vector<FurtherTexture>& textures) {
  for (const FurtherTexture& one : textures) images.push_back(asImage(one.image));
  for (size_t i = 0; i < textures.size(); ++i)
    maps.push_back(
        {sizeof(tks_object_map), textures[i].name.c_str(), &images[i], textures[i].weight});
}

std::string mapsNote(const std::vector<FurtherTexture>& given, std::vector<std::string> left_out,
                     bool is_resampled) {
  std::vector<std::string> names;
  for (const FurtherTexture& one : given) {
    if (is_resampled && kindOf(one.name) == static_cast<size_t>(MapKind::kNormal))
      left_out.push_back(one.name +
                         " (it counts from texture coordinates: --class triangles keeps "
                         "it)");
    else
      names.push_back(one.name + " " + sizeOf(one.image));
  }
  std::string note;
  if (!names.empty()) note = "maps taken along: " + joined(names);
  if (!left_out.empty())
    note += (note.empty() ? "maps left out: " : "; left out: ") + joined(left_out);
  return note;
}

}  // namespace tetrakis::tools
