// SPDX-License-Identifier: Apache-2.0
#include "api/object_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "base/portable_math.hpp"
#include "base/samples.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "encoder/views/view_inputs.hpp"
#include "ratecontrol/pictures/patch_texture.hpp"

namespace tetrakis::inline api {
namespace {

using ImageSpot = std::array<double, 2>;  ///< on an image, from (0, 0) to (1, 1)

/// A sample of a picture on an image: a place, and the level of detail.
struct ImagePlace {
  double u = 0, v = 0, level = 0;
};

/// Where a sample of a picture lies, from the places of the corners of its triangle on the image.
ImagePlace placeOn(Extent image, const std::array<ImageSpot, 3>& corners,
                   const SeenTriangle& seen) {
  const auto along = [&](size_t axis) {
    const double from = corners[0][axis];
    return from + double{seen.second} * (corners[1][axis] - from) +
           double{seen.third} * (corners[2][axis] - from);
  };
  const auto side = [&](size_t corner, size_t axis) {
    return corners[corner][axis] - corners[0][axis];
  };
  const double texels = std::abs(side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0)) / 2 *
                        static_cast<double>(image.samples());
  const double wide = texels / std::max(double{seen.samples}, 1e-30);
  const bool is_coarser = wide > 1 && std::isfinite(wide);
  return {along(0), along(1), is_coarser ? portable::log2(wide) / 2 : 0};
}

/// The image of a mesh repeats. A place that is no number is its corner.
Colour repeated(const ScreenTexture& texture, const ImagePlace& place) {
  const auto inside = [](double at) { return std::isfinite(at) ? at - std::floor(at) : 0; };
  return texture.at(inside(place.u), inside(place.v), place.level);
}

Status unsound() {
  return {TKS_MISMATCH, "The stream of the object is not sound."};
}

/// A decoded object, ready to be drawn.
struct DecodedObject {
  std::vector<Vec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<ImageSpot> places;  ///< of the points on the texture
  Texels texels;
  int patch_depth = -1;  ///< of the texture; -1: it is no raster of patches

  std::array<ImageSpot, 3> placesOf(uint32_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return {places[a], places[b], places[c]};
  }
};

Result<DecodedObject> decodedObject(const std::vector<uint8_t>& stream) {
  tks_decoder* opened = nullptr;
  if (tks_open(stream.data(), stream.size(), nullptr, &opened, nullptr, 0) != TKS_OK)
    return unsound();
  const OwnDecoder decoder(opened);
  tks_info info{};
  info.size = sizeof info;
  tks_object_mesh mesh{};
  if (tks_get_info(opened, &info) != TKS_OK ||
      tks_decode_object(opened, TKS_MESH_BUDGET, 0, &mesh) != TKS_OK)
    return unsound();
  const std::unique_ptr<tks_object_mesh, decltype(&tks_free_object_mesh)> held(
      &mesh, tks_free_object_mesh);
  Result<std::vector<uint16_t>> texels = decodedTexels(stream);
  if (!texels.ok()) return texels.status();
  if (mesh.texcoord == nullptr) return unsound();
  DecodedObject object;
  for (size_t i = 0; i < mesh.vertex_count; ++i) {
    const double* const at = mesh.position + 3 * i;
    object.points.push_back({at[0], at[1], at[2]});
    object.places.push_back({mesh.texcoord[2 * i], mesh.texcoord[2 * i + 1]});
  }
  for (size_t i = 0; i < 3 * size_t{mesh.triangle_count}; i += 3)
    object.triangles.push_back({mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
  object.texels = {info.texture_width, info.texture_height, info.texture_channels,
                   info.texture_sample == TKS_U8 ? 8 : 16, std::move(*texels)};
  object.texels.white_level = static_cast<uint16_t>(info.texture_white_level);
  if (info.texture_domain == TKS_DOMAIN_FOREST)
    object.patch_depth = static_cast<int>(info.texture_forest.depth);
  return object;
}

/// The place on a patch of a place on the raster of patches, whose texels' middles are samples.
PatchPlace onPatch(const ImagePlace& place, const Texels& raster, int depth) {
  const double n = std::ldexp(1.0, depth);
  const double column = place.u * raster.width - 0.5, row = place.v * raster.height - 0.5;
  const double patch = std::floor(std::max(row, 0.0) / (n + 1));
  const auto along = [n](double at) { return static_cast<float>(std::clamp(at / n, 0.0, 1.0)); };
  return {static_cast<uint32_t>(patch), along(column), along(row - patch * (n + 1)),
          static_cast<float>(place.level)};
}

/// The cameras of the caller, which are checked, or those all around the mesh. Some of the latter
/// may see nothing: a flat mesh shows them its edge.
Result<std::vector<Camera>> camerasOf(const tks_encode_options& options, const TriangleMesh& mesh) {
  if (options.camera_count == 0) {
    const Box box = boxAround(mesh.points);
    return camerasAround({box.low, box.high});
  }
  std::vector<Camera> cameras = givenCameras(options);
  for (const Camera& camera : cameras)
    if (Status status = checkCamera(camera); !status.ok()) return status;
  const auto counts = [](const Camera& camera) { return camera.weight > 0; };
  if (std::none_of(cameras.begin(), cameras.end(), counts))
    return misusedObject("No camera has a weight above 0.");
  return cameras;
}

}  // namespace

Result<ObjectPictures> ObjectPictures::of(const GivenObject& given) {
  const TriangleMesh& mesh = given.source.cleaned().mesh;
  Result<std::vector<Camera>> cameras = camerasOf(given.options, mesh);
  if (!cameras.ok()) return cameras.status();
  ObjectPictures pictures(*std::move(cameras));
  pictures.seen_ = pictures.pictures_.seenOf({mesh.points, mesh.triangles});
  const size_t blind = pictures.pictures_.firstBlind(pictures.seen_);
  if (given.options.camera_count > 0 && blind < pictures.pictures_.cameras().size())
    return misusedObject("Camera '" + pictures.pictures_.cameras()[blind].name +
                         "' sees nothing of the mesh.");
  const std::shared_ptr<const TextureSource> image = quantiseTexture(*given.image);
  const ScreenTexture texture(image->texels, image->texels.extent());
  const std::vector<TriangleSource>& sources = given.source.cleaned().sources;
  pictures.colours_ = pictures.pictures_.coloursOf(pictures.seen_, [&](size_t sample) {
    const SeenTriangle& seen = pictures.seen_[sample];
    const TriangleSource& source = sources[seen.triangle];
    std::array<ImageSpot, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
      const float* const at =
          given.mesh.texcoords + 2 * (3 * size_t{source.triangle} + source.corners[k]);
      corners[k] = {double{at[0]}, double{at[1]}};
    }
    return repeated(texture, placeOn(image->texels.extent(), corners, seen));
  });
  return pictures;
}

Result<double> ObjectPictures::errorOf(const std::vector<uint8_t>& stream) const {
  const Result<DecodedObject> object = decodedObject(stream);
  if (!object.ok()) return object.status();
  const std::vector<SeenTriangle> seen = pictures_.seenOf({object->points, object->triangles});
  const Texels& texels = object->texels;
  const auto placeAt = [&](size_t sample) {
    return placeOn(texels.extent(), object->placesOf(seen[sample].triangle), seen[sample]);
  };
  std::vector<Colour> colours;
  if (object->patch_depth >= 0) {
    const PatchTexture texture(texels, object->patch_depth);
    colours = pictures_.coloursOf(seen, [&](size_t sample) {
      return texture.at(onPatch(placeAt(sample), texels, object->patch_depth));
    });
  } else {
    const ScreenTexture texture(texels, texels.extent());
    colours = pictures_.coloursOf(
        seen, [&](size_t sample) { return repeated(texture, placeAt(sample)); });
  }
  return pictures_.errorBetween({seen_, colours_}, {seen, colours});
}

}  // namespace tetrakis::inline api
