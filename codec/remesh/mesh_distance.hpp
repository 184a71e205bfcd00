// SPDX-License-Identifier: Apache-2.0
// How far two surfaces are apart, by samples of each and the nearest places of the other, as Metro
// measures it (Cignoni, Rocchini, Scopigno, 1998).
#pragma once

#include <cstddef>

#include "codec/remesh/triangle_mesh.hpp"
#include "codec/remesh/triangle_tree.hpp"

namespace tetrakis::inline remesh {

constexpr size_t kDistanceSamples = 20000;

/// `count` places of a mesh, as dense everywhere: the same ones in each call. A mesh without area
/// has as many in each triangle, one without triangles none.
std::vector<SurfacePoint> evenPlaces(const TriangleMesh& mesh, size_t count);

/// From the places of one surface to another one, in the unit of the points.
struct OneWayDistance {
  double rms = 0;
  double largest = 0;
};

/// From `count` places of `from` to the mesh of `to`. Infinite if that has no triangles.
OneWayDistance distanceTo(const TriangleTree& to, const TriangleMesh& from,
                          size_t count = kDistanceSamples);

struct MeshDistance {
  OneWayDistance to_second, to_first;
  double error = 0;  ///< the larger RMS
  double psnr = 0;  ///< in dB: of the diagonal of the first mesh to `error`; infinite without error
};

/// With `count` places of each. An empty mesh is infinitely far from others.
MeshDistance meshDistance(const TriangleMesh& first, const TriangleMesh& second,
                          size_t count = kDistanceSamples);

/// The trees' own meshes, for measuring one mesh against many.
MeshDistance meshDistance(const TriangleTree& first, const TriangleTree& second,
                          size_t count = kDistanceSamples);

}  // namespace tetrakis::inline remesh
