// SPDX-License-Identifier: Apache-2.0
// decimate() takes a surface and returns a MeshSequence, the order in which its vertices enter
// meshes of more and more triangles. It joins two orders: generalDecimation(), which is best and
// slow, and saturatedOrder(), which is fast.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/mesh/decimation/merging_domains.hpp"
#include "codec/mesh/decimation/worth.hpp"
#include "codec/mesh/surface/surface.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline decimation {

// saturatedOrder() sorts vertices by saturated slopes, from the error and the cost of each. Where
// vertices are worth little the order is nearly as good as that of general decimation, and takes a
// fraction of its time.

/// Sorts vertices by saturated slopes (Ohlberger and Rumpf 1999): the saturated slope of a vertex
/// is the greatest among its own and those of its descendants. Returns vertices in falling order of
/// these slopes, parents before children, as many as cost `most` or more in all.
/// errors: what the removal of each vertex costs; an error may be negative.
std::vector<VertexId> saturatedOrder(const std::vector<double>& errors, const VertexCosts& costs,
                                     uint64_t most);

// generalDecimation() orders all vertices by general decimation with global error (thesis 5.2.2):
// from full resolution down, each step removes the merging domain M_v (v and its remaining
// descendants) that costs least, lambda(v) = -deltaD / deltaR (5.2): squared error per triangle, or
// per unit of another cost.

/// Returns all vertices, those removed last first. gains: one for each vertex (gains/gains.hpp).
/// prompt_levels (merging_domains.hpp) changes the time that decimation takes, but not the order.
/// steps: takes the number of vertices that each step removes, first step first; nullptr: none.
std::vector<VertexId> generalDecimation(const std::vector<double>& gains, const VertexCosts& costs,
                                        uint32_t prompt_levels = MergingDomains::kPromptLevels,
                                        std::vector<uint32_t>* steps = nullptr);

// Rate-distortion decimation (thesis 5) orders all vertices of a surface for insertion into a 4-8
// mesh. Every prefix of the order is a conforming mesh with little error for its triangles, and the
// meshes are nested.
//
// The thesis updates all ancestors of a vertex when the vertex is removed. Here a queue holds lower
// bounds of the slopes (slope_queue.hpp), and a vertex is looked at again when it comes to the
// front; meanwhile its merging domain keeps its size and worth (merging_domains.hpp).

/// The progressive order of all vertices of a surface.
class MeshSequence {
 public:
  MeshSequence(Lattice lattice, std::vector<VertexId> order, const std::vector<double>& gains);

  const Lattice& lattice() const { return lattice_; }
  /// Vertices in insertion order, parents before children, hidden ones included.
  const std::vector<VertexId>& order() const { return order_; }
  /// The number of triangles of the mesh of the first `inserted` vertices, 0 ... order().size(). It
  /// never falls as vertices are inserted.
  uint32_t triangleCount(size_t inserted) const { return triangle_counts_[inserted]; }
  /// The error of that mesh: the sum over all samples of weight * (sample - mesh)^2, in squared
  /// height steps.
  double squaredError(size_t inserted) const { return squared_errors_[inserted]; }

  /// The shortest prefix with the least error among those of at most `triangles` triangles; 0, the
  /// roots alone, where even they have more.
  size_t bestPrefix(uint32_t triangles) const;
  LatticeMesh mesh(size_t inserted) const;

 private:
  Lattice lattice_;
  std::vector<VertexId> order_;
  std::vector<uint32_t> triangle_counts_;
  std::vector<double> squared_errors_;
};

/// Orders all vertices by general decimation. The coarsest meshes of the order, those of up to 4096
/// triangles and of no more than one for each 8 samples, pass through the corners of the hull of
/// the meshes within them (closure/closure.hpp). Fails with the errors of Lattice::make, and with
/// TKS_USAGE for weights that are not one for each sample, negative or not finite.
Result<MeshSequence> decimate(const SurfaceView& surface);

}  // namespace tetrakis::inline decimation
