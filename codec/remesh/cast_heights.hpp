// SPDX-License-Identifier: Apache-2.0
// castHeights() finds how high the surface of a mesh lies over each sample of a base. It follows a
// line along the normal of the base to where the line meets the mesh. If there are several such
// places, the map of the decimation tells which one belongs to the sample (I. Guskov, K. Vidimce,
// W. Sweldens and P. Schroeder, "Normal meshes", 2000).
#pragma once

#include <functional>
#include <vector>

#include "codec/basemesh/bent_base.hpp"
#include "codec/remesh/triangle_tree.hpp"

namespace tetrakis::inline remesh {

/// A surface over a base mesh: a height and a place for each sample of the forest's raster.
struct CastSurface {
  std::vector<float> heights;
  std::vector<SurfacePoint> places;  ///< the places of the mesh that the samples show
};

/// place_of(patch, x, y): the place of the mesh to which the map takes a sample of a patch. x and y
/// run from 0 to 1 along the sides of the patch. Samples that patches share get the result of the
/// patch that owns them.
CastSurface castHeights(
    const BaseMesh& base, const TriangleTree& mesh,
    const std::function<SurfacePoint(uint32_t patch, double x, double y)>& place_of);

/// So many triangles of meshOfSamples() that follow on each other lie side by side.
inline constexpr uint32_t kSampleTriangles = 8;

/// The surface over a base as a mesh: each square between four samples becomes two triangles.
TriangleMesh meshOfSamples(const BaseMesh& base, const std::vector<float>& heights);

}  // namespace tetrakis::inline remesh
