// SPDX-License-Identifier: Apache-2.0
// meshDistance() measures how far two surfaces are apart. It takes places of either surface and
// finds the nearest place of the other one, as Metro does (Cignoni, Rocchini, Scopigno, 1998).
#pragma once

#include <cstddef>

#include "codec/remesh/triangle_mesh.hpp"
#include "codec/remesh/triangle_tree.hpp"

namespace tetrakis::inline remesh {

constexpr size_t kDistanceSamples = 20000;  ///< places of each surface, where nobody says how many

/// `count` places of a mesh, spread evenly over its area. Each call gives the same ones. If the
/// mesh has no area, its triangles get equally many; if it has no triangles, there are no places.
std::vector<SurfacePoint> evenPlaces(const TriangleMesh& mesh, size_t count);

/// Distances from places of one surface to the other one, in the unit of the points.
struct OneWayDistance {
  double rms = 0;
  double largest = 0;
};

struct MeshDistance {
  OneWayDistance to_second, to_first;
  double error = 0;  ///< the larger one of both RMS
  /// The ratio of the first mesh's diagonal to `error`, in dB. Infinite if `error` is 0.
  double psnr = 0;
};

/// The distance between the meshes of two trees, by `count` places of each. An empty mesh is
/// infinitely far from one that has triangles.
MeshDistance meshDistance(const TriangleTree& first, const TriangleTree& second,
                          size_t count = kDistanceSamples);

}  // namespace tetrakis::inline remesh
