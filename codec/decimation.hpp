// SPDX-License-Identifier: Apache-2.0
// RD decimation (thesis 5.2.2): general decimation of a 4-8 mesh with global error.
//
// From full resolution down, each step removes the merging domain M_v (v and its remaining
// descendants) that costs least, lambda(v) = -deltaD / deltaR (5.2): squared error per triangle.
// The steps reversed are an order of insertion whose prefixes are nested, conforming meshes.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/lattice.hpp"
#include "codec/lattice_mesh.hpp"
#include "codec/surface_view.hpp"

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
  /// Sum over all samples of (sample - mesh)^2, in squared height steps.
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

/// The errors of Lattice::make.
Result<MeshSequence> decimate(const SurfaceView& surface);

}  // namespace tetrakis
