// SPDX-License-Identifier: Apache-2.0
// RD decimation (thesis 5): an order of insertion of all vertices of a 4-8 mesh whose prefixes are
// nested, conforming meshes, good at every rate.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/lattice.hpp"
#include "codec/mesh/lattice_mesh.hpp"
#include "codec/mesh/surface_view.hpp"

namespace tetrakis {

/// The progressive order of all vertices of a surface.
class MeshSequence {
 public:
  MeshSequence(Lattice lattice, std::vector<VertexId> order, const std::vector<double>& gains);

  const Lattice& lattice() const { return lattice_; }
  /// Vertices in insertion order, parents before children, hidden ones included.
  const std::vector<VertexId>& order() const { return order_; }
  /// Of the mesh after `inserted` vertices, 0 ... order().size(); never falls.
  uint32_t triangleCount(size_t inserted) const { return triangle_counts_[inserted]; }
  /// Sum over all samples of weight * (sample - mesh)^2, in squared height steps.
  double squaredError(size_t inserted) const { return squared_errors_[inserted]; }

  /// The shortest prefix with the least error among those of at most `triangles` triangles; 0, the
  /// roots alone, where even they have more.
  size_t bestPrefix(uint32_t triangles) const;
  LatticeMesh mesh(size_t inserted) const;
  LatticeMesh meshWithAtMost(uint32_t triangles) const { return mesh(bestPrefix(triangles)); }

 private:
  Lattice lattice_;
  std::vector<VertexId> order_;
  std::vector<uint32_t> triangle_counts_;
  std::vector<double> squared_errors_;
};

/// How to choose the next vertex. The last three are the thesis's comparisons.
enum class MeshPolicy {
  /// General decimation; where costs are triangles its coarsest meshes then go through the corners
  /// of the hull of all meshes within one of 4096 triangles, on small surfaces one of a triangle
  /// for each 8 samples (closure.hpp).
  kNearHull,
  kGeneralDecimation,     ///< whole merging domains, global error (general_decimation.hpp)
  kRestrictedDecimation,  ///< single vertices, global error (leaf_order.hpp; thesis 5.4.2)
  kLocalDecimation,       ///< single vertices, error at the vertex alone (thesis 2.5.2, 5.5.2)
  kLocalRefinement,       ///< insertion from the roots, likewise (thesis 2.5.2, 5.5.2)
};

struct DecimationOptions {
  MeshPolicy policy = MeshPolicy::kNearHull;
  /// One for each lattice vertex, in any unit (vertex_costs.hpp); empty: triangles.
  std::span<const uint32_t> costs;
};

/// The errors of Lattice::make; TKS_USAGE for weights or costs that are not one each, or weights
/// negative or not finite; TKS_LIMIT for costs that add up to 2^32 or more.
Result<MeshSequence> decimate(const SurfaceView& surface, const DecimationOptions& options = {});

}  // namespace tetrakis
