// SPDX-License-Identifier: Apache-2.0
// castHeights() finds how high the surface of a mesh lies over each sample of a base: it follows
// the base's normal to the place where the mesh is met. A line may meet the mesh in several places;
// the map of the decimation tells which of them belongs to the sample (I. Guskov, K. Vidimce, W.
// Sweldens and P. Schroeder, "Normal meshes", 2000).
#pragma once

#include <functional>
#include <vector>

#include "codec/basemesh/bent_base.hpp"
#include "codec/remesh/triangle_tree.hpp"

namespace tetrakis::inline remesh {

/// A surface over a base mesh, one of each for every sample of the forest's raster.
struct CastSurface {
  std::vector<float> heights;
  std::vector<SurfacePoint> places;  ///< on the mesh: what the sample shows
};

/// place_of(patch, x, y): where the map takes a sample of a patch, x and y from 0 to 1 of its side.
/// What patches share is taken from the patch that owns it.
CastSurface castHeights(
    const BaseMesh& base, const TriangleTree& mesh,
    const std::function<SurfacePoint(uint32_t patch, double x, double y)>& place_of);

/// The surface of a forest's samples as a mesh: two triangles for each square of four.
TriangleMesh meshOfSamples(const BaseMesh& base, const std::vector<float>& heights);

}  // namespace tetrakis::inline remesh
