// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/surface_comparison.hpp"

#include <algorithm>

#include "apps/tools/report/painted_mesh.hpp"

namespace tetrakis::tools {
Result<SurfaceMeasurement> compareSurface(Decoder& decoder, const SurfaceFile& original,
                                          uint32_t max_triangles) {
  const PaintedMesh first{{original.points, original.triangles},
                          original.texcoords,
                          original.texcoords.empty() ? std::nullopt : original.texture};
  const Result<PaintedMesh> second = decodedMesh(decoder, max_triangles);
  if (!second.ok()) return second.status();
  const TriangleTree first_tree(first.mesh), second_tree(second->mesh);
  SurfaceMeasurement measured;
  measured.triangles = static_cast<uint32_t>(second->mesh.triangles.size());
  measured.distance = meshDistance(first_tree, second_tree);
  if (first.image && second->image)
    measured.colour_psnr = colourPsnr(std::max(colourError(first, *second, second_tree),
                                               colourError(*second, first, first_tree)));
  return measured;
}

}  // namespace tetrakis::tools
