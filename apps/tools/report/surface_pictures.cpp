// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/surface_pictures.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "apps/tools/files/stream.hpp"
#include "apps/tools/report/object_mesh.hpp"

namespace tetrakis::tools {
namespace {

/// With its texture every corner of a triangle is a vertex of its own: charts of the image touch.
MeshFile meshOf(const SurfaceFile& surface, bool textured) {
  MeshFile mesh;
  const auto add = [&](const std::array<double, 3>& point) {
    for (const double part : point) mesh.positions.push_back(static_cast<float>(part));
  };
  if (!textured) {
    for (const auto& point : surface.points) add(point);
    for (const auto& triangle : surface.triangles)
      mesh.triangles.insert(mesh.triangles.end(), triangle.begin(), triangle.end());
    return mesh;
  }
  mesh.texture = &*surface.texture;
  mesh.texture_repeats = true;
  for (const auto& triangle : surface.triangles) {
    for (const uint32_t corner : triangle) {
      mesh.triangles.push_back(static_cast<uint32_t>(mesh.triangles.size()));
      add(surface.points[corner]);
    }
  }
  for (const auto& place : surface.texcoords)
    mesh.texcoords.insert(mesh.texcoords.end(), place.begin(), place.end());
  return mesh;
}

/// The image that the texture coordinates of objectMesh() refer to; none without a texture.
Result<std::optional<ImageFile>> pictureOf(Decoder& decoder) {
  const tks_info& info = decoder.info();
  if (info.has_texture == 0) return std::optional<ImageFile>();
  Result<ImageFile> raster = decodeImage(decoder);
  if (!raster.ok()) return raster.status();
  return std::optional(hasAtlas(info) ? atlasOf(info).pictureOf(*raster) : std::move(*raster));
}

}  // namespace

Bounds boundsOf(const SurfaceFile& surface) {
  Bounds bounds{surface.points.front(), surface.points.front()};
  for (const auto& point : surface.points) {
    for (size_t axis = 0; axis < 3; ++axis) {
      bounds.low[axis] = std::min(bounds.low[axis], point[axis]);
      bounds.high[axis] = std::max(bounds.high[axis], point[axis]);
    }
  }
  return bounds;
}

Result<SurfacePictures> drawSurfaces(const SurfaceFile& original, Decoder& decoder,
                                     uint32_t max_triangles, CameraChoice choice) {
  if (choice.isDefault()) choice.view = "around";
  Result<std::vector<Camera>> cameras = chooseCameras(choice, boundsOf(original));
  if (!cameras.ok()) return cameras.status();
  if (std::none_of(cameras->begin(), cameras->end(), [](const auto& c) { return c.weight > 0; }))
    return Status(TKS_USAGE, "no camera has a weight above 0");
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create();
  if (!renderer.ok()) return renderer.status();
  Result<MeshFile> mesh = objectMesh(decoder, TKS_MESH_BUDGET, max_triangles);
  if (!mesh.ok()) return mesh.status();
  const Result<std::optional<ImageFile>> image = pictureOf(decoder);
  if (!image.ok()) return image.status();
  const bool textured = *image && original.texture && !original.texcoords.empty();
  if (textured) {
    mesh->texture = &**image;
    mesh->texture_repeats = !hasAtlas(decoder.info());
  }
  Result<std::vector<Picture>> originals = (*renderer)->draw(meshOf(original, textured), *cameras);
  if (!originals.ok()) return originals.status();
  Result<std::vector<Picture>> pictures = (*renderer)->draw(*mesh, *cameras);
  if (!pictures.ok()) return pictures.status();
  return SurfacePictures{std::move(*cameras), std::move(*originals), std::move(*pictures)};
}

double screenPsnr(const SurfacePictures& drawn) {
  std::vector<double> weights;
  for (const Camera& camera : drawn.cameras) weights.push_back(camera.weight);
  return screenPsnr(drawn.originals, drawn.pictures, weights);
}

}  // namespace tetrakis::tools
