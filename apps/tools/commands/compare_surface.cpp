// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/compare_surface.hpp"

#include <optional>
#include <utility>

#include "apps/tools/commands/notes.hpp"
#include "apps/tools/files/meshes/surface_colours.hpp"
#include "apps/tools/files/meshes/surface_file.hpp"
#include "apps/tools/report/object_mesh.hpp"
#include "apps/tools/report/surface_comparison.hpp"

namespace tetrakis::tools {
namespace {

/// With the texture that `encode` takes.
Result<SurfaceFile> readOriginal(const MeshReference& reference, const tks_info& info, bool quiet) {
  std::string remark;
  Result<SurfaceFile> mesh = readSurface(reference.mesh, &remark, reference.texture.empty());
  if (!mesh.ok()) return mesh.status();
  if (!remark.empty()) tellNote(quoted(reference.mesh) + ": " + remark, quiet);
  if (!reference.texture.empty()) {
    if (mesh->texcoords.empty())
      return Status(TKS_USAGE, quoted(reference.mesh) +
                                   " has no texture coordinates, so that --texture cannot lie on "
                                   "it");
    Result<ImageFile> image = readImage(reference.texture, &remark);
    if (!image.ok()) return image.status();
    tellNote(remark, quiet);
    mesh->texture = withoutAlpha(*image);
    mesh->texture->white_level = info.texture_white_level;
  } else if (mesh->texture) {
    mesh->texture = shownTexture(*mesh);
  }
  return mesh;
}

Json decibels(std::optional<double> psnr) {
  return psnr ? finiteOrNull(*psnr) : Json();
}

}  // namespace

Result<Json> compareWithMesh(OpenStream& stream, const MeshReference& reference, bool quiet) {
  const tks_info& info = stream.decoder.info();
  if (!isObject(info))
    return Status(TKS_USAGE,
                  "--mesh is for streams that hold an object: give --height or "
                  "--texture");
  const Result<SurfaceFile> original = readOriginal(reference, info, quiet);
  if (!original.ok()) return original.status();
  const Result<SurfaceMeasurement> measured =
      compareSurface(stream.decoder, *original, reference.triangles);
  if (!measured.ok()) return measured.status();
  tellNote(coarsestNote(measured->triangles, reference.triangles), quiet);
  const MeshDistance& distance = measured->distance;
  return Json{{"bytes", info.available_bytes},
              {"geometry_bytes", info.geometry_bytes},
              {"texture_bytes", info.texture_bytes},
              {"triangles", measured->triangles},
              {"rms_distance", distance.error},
              {"rms_to_stream", distance.to_second.rms},
              {"rms_to_mesh", distance.to_first.rms},
              {"largest_to_stream", distance.to_second.largest},
              {"largest_to_mesh", distance.to_first.largest},
              {"surface_psnr", finiteOrNull(distance.psnr)},
              {"colour_psnr", decibels(measured->colour_psnr)}};
}

}  // namespace tetrakis::tools
