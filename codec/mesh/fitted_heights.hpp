// SPDX-License-Identifier: Apache-2.0
// FittedSequence takes a surface and returns meshes of it whose heights are the least squares over
// all samples, which errs less than a mesh through samples does; fitMesh() fits one mesh, and
// withTurnedEdges() turns its edges as well.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/fitting/fitting.hpp"
#include "codec/mesh/surface/surface.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline mesh {

// fitMesh() moves the heights of a mesh to the least squares over all samples of a surface, and
// FittedSequence orders vertices for meshes whose heights are fitted in this way.
//
// With fitted heights a vertex is worth less than its gain says, because the heights of its
// neighbours partly make up for its absence. So the order of decimate() is refined: at every
// halving of the triangles the mesh is fitted, gains are computed anew with the fitted heights (the
// error is still a sum over vertices, and the best sets are nested), and the remaining vertices are
// sorted by the slopes of those closures. Fitting alone saves 10 to 16 % of the root mean squared
// error, the new order another 2 to 3 %.

struct FittedMesh {
  LatticeMesh mesh;
  std::vector<double> heights;  ///< of each vertex of the mesh, in height steps
};

/// Least-squares heights of the mesh of a closed set.
FittedMesh fitMesh(const Lattice& lattice, const WeightedSurface& surface,
                   std::span<const VertexId> vertices);

class FittedSequence {
 public:
  /// Makes a sequence for meshes of any number of triangles, which begins with the order of
  /// decimate(). Fails with the errors of decimate(). The surface must outlive the sequence.
  static Result<FittedSequence> make(const WeightedSurface& surface);
  /// Makes, in a fraction of the time, a sequence that is good only at about that many triangles,
  /// and ends soon behind them. Fails and refers to the surface as make() does.
  static Result<FittedSequence> makeFor(const WeightedSurface& surface, uint32_t triangles);

  const Lattice& lattice() const { return lattice_; }
  /// Vertices in insertion order, parents before children, hidden ones included: meshes are nested.
  const std::vector<VertexId>& order() const { return order_; }
  /// The longest prefix of at most `triangles` triangles; 0, the roots alone, where even they have
  /// more.
  size_t longestPrefix(uint32_t triangles) const;
  /// Least-squares heights.
  FittedMesh mesh(size_t inserted) const;

 private:
  FittedSequence(Lattice lattice, const WeightedSurface& surface, std::vector<VertexId> order);
  void refine();
  void refineFor(uint32_t wanted);
  void sortBySlope(size_t count, const FittedMoments& fitted);
  void sortBySide(size_t count, const FittedMoments& fitted, uint32_t triangles);

  Lattice lattice_;
  WeightedSurface surface_;
  std::vector<VertexId> order_;
};

// withTurnedEdges() turns edges of a fitted mesh, so that its triangles follow ridges and valleys
// of any direction.
//
// The edges of a 4-8 mesh have eight directions, so it takes many small triangles along a crest
// that has another one. Here two triangles that share an edge become the other two of their four
// corners wherever that errs less (data-dependent triangulation: Dyn, Levin and Rippa 1990), and
// heights are fitted anew. Vertices and the number of triangles stay; the mesh is no longer one of
// the lattice.

/// The mesh with its edges turned and its heights fitted anew. The squared error over the known
/// samples never grows. Triangles stay counter-clockwise, cover the same ground and have an area;
/// those that touch an unknown sample stay as they are. The same bits with every compiler. mesh:
/// its vertices are samples of the surface.
FittedMesh withTurnedEdges(const WeightedSurface& surface, FittedMesh mesh);

}  // namespace tetrakis::inline mesh
