// SPDX-License-Identifier: Apache-2.0
// MappedDecimation makes base meshes of few triangles, and tells where each place of a base lies on
// the mesh that it was made of (MAPS, Lee et al. 1998). Points collapse into neighbours, the
// cheapest one first, so that each point of a base is a point of the mesh. The surface keeps its
// topology. The map between base and mesh is one to one by construction, whatever the genus.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "codec/remesh/collapse_cost.hpp"
#include "codec/remesh/collapse_map.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

struct DecimatedMesh {
  TriangleMesh mesh;
  std::vector<uint32_t> triangles;  ///< for each triangle its number in the input
  /// For each triangle the last collapse that changed it, or kNone.
  std::vector<uint32_t> collapses;
};

class MappedDecimation {
 public:
  /// Collapses points until there are no more than `fewest` triangles, or no point can be
  /// collapsed. `mesh` is one that `cleaned()` has returned; it outlives this. A closed component
  /// keeps at least four triangles, and one with a boundary at least two.
  MappedDecimation(const TriangleMesh& mesh, uint32_t fewest,
                   DecimationAim aim = DecimationAim::kEven);
  ~MappedDecimation();
  MappedDecimation(const MappedDecimation&) = delete;
  MappedDecimation& operator=(const MappedDecimation&) = delete;

  /// Goes on to fewer triangles, as if the decimation had been made for them.
  void goOn(uint32_t fewest);

  /// The number of triangles that are left so far.
  uint32_t fewest() const { return fewest_; }

  /// The first mesh of the run that had at most so many triangles, or else its last mesh.
  DecimatedMesh base(uint32_t most_triangles) const;

  /// Where a place of `base.mesh` lies on the input, of an even decimation. A corner goes to its
  /// point. A place on an edge goes to the same place from both triangles of the edge.
  SurfacePoint toInput(const DecimatedMesh& base, const SurfacePoint& place) const;

 private:
  class Decimator;

  const TriangleMesh& mesh_;
  CollapseMap map_;
  std::unique_ptr<Decimator> decimator_;
  uint32_t fewest_;
};

}  // namespace tetrakis::inline remesh
