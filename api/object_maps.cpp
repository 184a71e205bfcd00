// SPDX-License-Identifier: Apache-2.0
#include "api/object_maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <string_view>
#include <utility>

#include "api/guarded.hpp"
#include "bitstream/stream/header.hpp"
#include "tetrakis/components.h"

namespace tetrakis::inline api {
namespace {

/// What a unit of error of a map, whose white is 1, changes in the light of a picture, beside an
/// error of the colour: a normal that is off turns all light that falls on it, and emissive light
/// is added to it. Roughness moves highlights, and occlusion counts where no lamp shines.
constexpr double kSurfaceWeight = 0.25;

double usualWeight(std::string_view name) {
  return name == "metallic_roughness" || name == "occlusion" ? kSurfaceWeight : 1;
}

/// tks_combine counts errors in units of the range of values: what a weight becomes if they are to
/// count in units of white. Of an image of 16 bits white is what it shows as white.
double ofRange(const tks_image& image, double of_white) {
  if (image.sample != TKS_U8) return of_white;
  const auto* const data = static_cast<const uint8_t*>(image.data);
  const size_t values = size_t{image.width} * image.height * image.channels;
  const auto [least, most] = std::minmax_element(data, data + values);
  const double range = std::max(*most - *least, 1) / 255.0;
  return of_white * range * range;
}

/// Normals count from the texture coordinates, which patches have others of.
bool isTaken(const GivenMap& map, tks_object_kind kind) {
  return kind == TKS_OBJECT_TRIANGLES || map.name != "normal";
}

Result<std::vector<uint8_t>> encodedMap(GivenObject& given, const GivenMap& map,
                                        const CodedObject& coded) {
  tks_encode_options options = given.options;
  options.camera_count = 0;
  tks_image image = map.image;
  image.has_geotransform = 0;
  if (coded.kind == TKS_OBJECT_TRIANGLES) return encodedTrial(given, options, nullptr, &image);
  const PatchTexels texels(given, image, *coded.object, static_cast<int>(coded.texture_depth));
  return encodedTrial(given, options, nullptr, &texels.image());
}

void addMaterial(const GivenObject& given, CodedObject& coded) {
  if (given.mesh.material == nullptr || coded.kind == TKS_OBJECT_TRIANGLES) return;
  Result<ParsedHeader> parsed = readHeader(coded.stream);
  parsed->header.material = given.mesh.material;
  std::vector<uint8_t> stream = writeHeader(parsed->header);
  stream.insert(stream.end(), coded.stream.begin() + static_cast<ptrdiff_t>(parsed->bytes),
                coded.stream.end());
  coded.stream = std::move(stream);
}

}  // namespace

PatchTexels::PatchTexels(const GivenObject& given, const tks_image& image,
                         const ResampledObject& object, int depth)
    : forest_(depth, object.base.forest->sides()),
      shorts_(given.coloursOf(image).at(given.source.placesOn(object, depth))),
      image_(image) {
  if (image.sample == TKS_U8) bytes_.assign(shorts_.begin(), shorts_.end());
  const Extent raster = forest_.raster();
  image_.width = raster.width;
  image_.height = raster.height;
  image_.data = bytes_.empty() ? static_cast<const void*>(shorts_.data()) : bytes_.data();
  image_.has_geotransform = 0;
  image_.domain = TKS_DOMAIN_FOREST;
  image_.forest = {static_cast<uint32_t>(depth), forest_.patches(), forest_.sides().data()};
}

Result<std::vector<GivenMap>> takenMaps(const tks_triangle_mesh& mesh, bool has_image) {
  std::vector<GivenMap> maps;
  if (mesh.map_count == 0) return maps;
  if (mesh.maps == nullptr) return misusedObject("The maps of the mesh are missing.");
  if (!has_image) return misusedObject("Maps lie beside an image of the mesh, and there is none.");
  for (uint32_t i = 0; i < mesh.map_count; ++i) {
    tks_object_map given{};
    Status status = takeSized("the map", mesh.maps[i], offsetof(tks_object_map, weight), given);
    if (!status.ok()) return status;
    if (given.name == nullptr || given.image == nullptr)
      return misusedObject("A map has a name and an image.");
    if (!std::isfinite(given.weight) || given.weight < 0)
      return misusedObject("The weight of a map is a number from 0 on.");
    GivenMap& map = maps.emplace_back();
    map.name = given.name;
    map.weight = given.weight;
    status = takeSized("the map", *given.image, offsetof(tks_image, geotransform), map.image);
    if (status.ok()) status = checkMeshImage(mesh, &map.image);
    if (!status.ok()) return status;
  }
  return maps;
}

double shownTexels(const GivenObject& given) {
  double most = given.coloursOf(*given.image).shown();
  for (const GivenMap& map : given.maps)
    if (isTaken(map, TKS_OBJECT_RESAMPLED))
      most = std::max(most, given.coloursOf(map.image).shown());
  return most;
}

Result<CodedObject> withMaps(GivenObject& given, CodedObject coded) {
  addMaterial(given, coded);
  std::vector<tks_combined> streams(1);
  std::deque<std::vector<uint8_t>> of_maps;
  for (const GivenMap& map : given.maps) {
    if (!isTaken(map, coded.kind)) continue;
    Result<std::vector<uint8_t>> stream = encodedMap(given, map, coded);
    if (!stream.ok()) return stream.status();
    const std::vector<uint8_t>& bytes = of_maps.emplace_back(*std::move(stream));
    const double weight = map.weight > 0 ? map.weight : ofRange(map.image, usualWeight(map.name));
    streams.push_back({sizeof(tks_combined), bytes.data(), bytes.size(), map.name.c_str(), weight});
  }
  const uint64_t budget = given.options.bytes;
  if (of_maps.empty() && (budget == 0 || coded.stream.size() <= budget)) return coded;
  const double weight = given.image != nullptr ? ofRange(*given.image, 1) : 1;
  streams[0] = {sizeof(tks_combined), coded.stream.data(), coded.stream.size(), nullptr, weight};
  const tks_combine_options options{sizeof(tks_combine_options), budget, nullptr};
  tks_buffer combined{};
  std::string message(300, '\0');
  const tks_status status = tks_combine(streams.data(), static_cast<uint32_t>(streams.size()),
                                        &options, &combined, message.data(), message.size());
  if (status != TKS_OK) return Status(status, message.c_str());
  coded.stream.assign(combined.data, combined.data + combined.size);
  tks_free_buffer(&combined);
  return coded;
}

}  // namespace tetrakis::inline api
