// SPDX-License-Identifier: Apache-2.0
// fitHeights() takes a mesh of a surface and moves the heights of its vertices to the least squares
// over all samples. FittedMoments and momentsOf() sum the samples of its triangles for that, and
// withinRange() limits the result.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/surface/surface.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline fitting {

// withinRange() limits fitted heights to the range of the known samples, because a least-squares
// fit overshoots beside cliffs and shores: vertices of few triangles would lie below a flat sea, or
// above the summit.

/// Heights of vertices, none of them beyond those of the known samples.
std::vector<double> withinRange(const WeightedSurface& surface, std::vector<double> heights);

// momentsOf() and squaredErrorOf() compare the samples in one triangle with the plane through any
// heights at its corners.

/// A triangle between samples of a surface, at heights of one's choice. It has an area.
struct HeldTriangle {
  std::array<GridPoint, 3> corners;
  std::array<double, 3> heights;
};

/// Returns the moments (gains/gains.hpp) of the samples in the triangle but those at its corners,
/// which stand apart. Samples on an edge count half, on the border of the grid fully.
TriangleMoments momentsOf(const WeightedSurface& surface, const HeldTriangle& triangle);

/// The energy of momentsOf() alone.
double squaredErrorOf(const WeightedSurface& surface, const HeldTriangle& triangle);

/// A sample in a triangle: its barycentric coordinates and what it lies above the plane.
struct WeighedSample {
  double weight, a, b, p, residual;
};

void add(TriangleMoments& moments, const WeighedSample& sample);

/// Whether the edge lies on the border of the grid.
bool onBorder(const SurfaceView& grid, GridPoint from, GridPoint to);

// FittedMoments computes the moments of the samples in each triangle of a mesh against the plane
// through the heights at its corners, from which fittedCorrections() fits these heights.
//
// They are the moments of gains/gains.hpp, but the heights h at the vertices need not be samples.
// The samples at vertices belong to no triangle: a vertex adds the error z - h of its own sample.
// When a vertex is removed, its sample goes to the triangles on either side of the edge that it
// split, half to each. Coarsening the mesh merges triangles upwards, so that all stages of a
// decimation together cost one descent over the surface.

/// One triangle of a mesh. corners: samples of a, b, apex.
struct FittedLeaf {
  std::array<uint32_t, 3> corners;
  TriangleMoments moments;
};

class FittedMoments {
 public:
  /// Begins with the mesh of all vertices, whose heights are the samples. The lattice and the
  /// surface must outlive this object.
  FittedMoments(const Lattice& lattice, const WeightedSurface& surface);

  /// Removes all vertices of the mesh but `kept`, a closed set.
  void coarsen(std::span<const VertexId> kept);
  /// Adds corrections[i] to the height at samples[i], each a vertex of the mesh.
  void correct(std::span<const uint32_t> samples, std::span<const double> corrections);

  /// Triangles of the mesh after the first coarsen(), in the order of meshOf().
  const std::vector<FittedLeaf>& leaves() const { return leaves_; }
  /// The height of the mesh at `sample`, which is the place of one of its vertices.
  double height(uint32_t sample) const { return heights_[sample]; }
  /// The heights of all samples, of which those of vertices count.
  std::span<const double> heights() const { return heights_; }
  const WeightedSurface& surface() const { return surface_; }

  /// The gain of each vertex of the mesh with the present heights (gains/gains.hpp). vertices:
  /// those of the mesh. Must not be called before coarsen().
  std::vector<double> gains(std::span<const VertexId> vertices) const;

 private:
  friend class FittedDescent;

  const Lattice& lattice_;
  WeightedSurface surface_;
  std::vector<bool> present_;    ///< of each lattice vertex
  std::vector<double> heights_;  ///< of each sample; those of vertices count
  std::vector<FittedLeaf> leaves_;
  /// The moments of triangles that overhang the grid, against planes through their samples, by
  /// split vertex and side. Each triangle is rasterised once.
  mutable std::map<uint64_t, TriangleMoments> rasters_;
  bool full_ = true;  ///< all leaves are of full resolution, empty, and not stored
};

// fitHeights() replaces the heights at the vertices of a mesh by those that fit the surface best.
//
// A mesh with heights h is the function sum over vertices k of h_k phi_k, phi_k the hat of vertex
// k. Its squared error over the samples z with weights w is least where
//
//   A h = b,   A_jk = sum of w phi_j phi_k,   b_k = sum of w z phi_k
//
// (thesis 5.A fits planes to triangles; here all triangles share their corners). A is a mass
// matrix: scaled by its diagonal its condition is at most 4 (Wathen 1987), so a few steps of
// conjugate gradients solve it.

/// Moves the heights of a coarsened mesh to the least squares. A vertex whose own sample has no
/// weight stays where it is as far as no other sample says more. The same bits with every compiler.
void fitHeights(FittedMoments& mesh);

/// What the least squares add to the height at each of these samples, the vertices of a mesh.
struct HeightCorrections {
  std::vector<uint32_t> samples;
  std::vector<double> corrections;
};

/// The corrections of the heights of a mesh of any triangles. leaves: their moments against the
/// planes through `heights`, which has one for each sample; those of vertices count.
HeightCorrections fittedCorrections(const WeightedSurface& surface,
                                    std::span<const FittedLeaf> leaves,
                                    std::span<const double> heights);

}  // namespace tetrakis::inline fitting
