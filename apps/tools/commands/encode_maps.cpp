// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/encode_maps.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <sstream>
#include <utility>

#include "apps/tools/commands/encode_inputs.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/output/progress.hpp"

namespace tetrakis::tools {
namespace {

/// What a unit of error of a map, whose white is 1, changes in the light of a picture, beside an
/// error of the colour, by MapKind: a normal that is off turns all light that falls on it, and
/// emissive light is added to it. Roughness moves highlights, and occlusion counts where no lamp
/// shines.
constexpr std::array<double, kMapKinds> kMapWeights = {1, 0.25, 0.25, 1};

size_t kindOf(const std::string& name) {
  return static_cast<size_t>(std::find(kMapNames.begin(), kMapNames.end(), name) -
                             kMapNames.begin());
}

/// What lies between the least and the largest value of an image, in parts of white. tks_combine
/// counts errors in units of that range.
double rangeOf(const ImageFile& image) {
  const auto [least, most] = std::minmax_element(image.data.begin(), image.data.end());
  const int range = std::to_integer<int>(*most) - std::to_integer<int>(*least);
  return std::max(range, 1) / 255.0;
}

/// Of an image of 16 bits white is what it shows as white.
double weightOf(const ImageFile& image, double of_white) {
  if (image.sample != TKS_U8) return of_white;
  return of_white * rangeOf(image) * rangeOf(image);
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
  const double weight = weightOf(*image, kind < kMapKinds ? kMapWeights[kind] : 1);
  textures.push_back({file.name, std::move(*image), weight});
  return {};
}

Result<Buffer> encoded(const EncodeArguments& arguments, const ImageFile& image, bool quiet) {
  EncodeArguments one;
  one.bytes = arguments.bytes;
  one.threads = arguments.threads;
  one.weights = arguments.weights;
  one.index = arguments.index;
  Result<tks_encode_options> options = encodeOptions(one, Reference());
  if (!options.ok()) return options.status();
  Progress progress("encoding", quiet);
  options->progress = &Progress::report;
  options->user = &progress;
  const tks_image given = asImage(image);
  return tetrakis::encode(nullptr, &given, *options);
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
    const double weight = weightOf(map.image, kMapWeights[kind]);
    textures.push_back({kMapNames[kind], std::move(map.image), weight});
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
  const bool has_maps = !mesh.maps.taken.empty() || mesh.maps.has_even;
  if (!mesh.texture && !has_maps) return;
  tellNote(std::string(!has_maps      ? "the texture is left out: it goes"
                       : mesh.texture ? "the texture and other maps are left out: they go"
                                      : "the maps are left out: they go") +
               " with --bytes alone",
           quiet);
  mesh.texture.reset();
  mesh.maps = {};
}

uint32_t longestSide(const std::vector<FurtherTexture>& textures) {
  uint32_t longest = 0;
  for (const FurtherTexture& one : textures)
    longest = std::max({longest, one.image.width, one.image.height});
  return longest;
}

Result<Buffer> withFurther(const EncodeArguments& arguments, const Buffer& stream,
                           const ImageFile& texture, const std::vector<FurtherTexture>& further,
                           bool quiet) {
  std::vector<NamedFile> files = {{"", arguments.height, weightOf(texture, 1)}};
  for (const FurtherTexture& one : further) files.push_back({one.name, one.name, one.weight});
  std::vector<Buffer> others;
  std::vector<tks_combined> streams = {asCombined(files[0], stream.bytes())};
  for (size_t i = 0; i < further.size(); ++i) {
    Result<Buffer> other = encoded(arguments, further[i].image, quiet);
    if (!other.ok()) return other.status();
    others.push_back(*std::move(other));
    streams.push_back(asCombined(files[i + 1], others.back().bytes()));
  }
  const tks_limits limits = limitsOfTools();
  Result<Buffer> combined =
      combine(streams, {sizeof(tks_combine_options), arguments.bytes, &limits});
  if (!combined.ok()) return aboutFile(combined.status(), files);
  return combined;
}

std::string resampledMapsNote(const std::vector<FurtherTexture>& left_out) {
  std::vector<std::string> names;
  for (const FurtherTexture& one : left_out) names.push_back(one.name);
  if (names.empty()) return "";
  return "maps left out: " + joined(names) + ", which lie on triangles as they are: --class " +
         "triangles keeps them";
}

std::string mapsNote(const std::vector<FurtherTexture>& taken,
                     const std::vector<std::string>& left_out) {
  std::vector<std::string> names;
  for (const FurtherTexture& one : taken) names.push_back(one.name + " " + sizeOf(one.image));
  std::string note;
  if (!names.empty()) note = "maps taken along: " + joined(names);
  if (!left_out.empty())
    note += (note.empty() ? "maps left out: " : "; left out: ") + joined(left_out);
  return note;
}

}  // namespace tetrakis::tools
