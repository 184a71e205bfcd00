// SPDX-License-Identifier: Apache-2.0
// MappedDecimation finds base meshes of few triangles, and where each of their places lies on the
// mesh that they come from (MAPS, Lee et al. 1998). Points collapse into neighbours, the cheapest
// one first, so that points of a base are points of the mesh; the surface keeps its topology, and
// base and mesh have a one-to-one map by construction, whatever the genus.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/remesh/collapse_map.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

struct DecimatedMesh {
  TriangleMesh mesh;
  std::vector<uint32_t> points;     ///< for each point the one of the input that lies there
  std::vector<uint32_t> triangles;  ///< the number that each triangle has in the input
  std::vector<uint32_t> collapses;  ///< the last one that changed each triangle, or kNone
};

class MappedDecimation {
 public:
  /// Collapses until there are no more than `fewest` triangles, or no point can go. `mesh`: as
  /// `cleaned()` returns it; outlives this. Components keep a tetrahedron at least, or two
  /// triangles if they have a boundary.
  MappedDecimation(const TriangleMesh& mesh, uint32_t fewest);

  /// Triangles at the end.
  uint32_t fewest() const { return fewest_; }

  /// The first mesh of the run with at most so many triangles, or the last one of all.
  DecimatedMesh base(uint32_t most_triangles) const;

  /// `place`: of `base.mesh`. Corners go to their points, and a place on an edge to one place,
  /// whichever of its triangles it is given in.
  SurfacePoint toInput(const DecimatedMesh& base, const SurfacePoint& place) const;

 private:
  const TriangleMesh& mesh_;
  CollapseMap map_;
  uint32_t fewest_;
};

}  // namespace tetrakis::inline remesh
