// SPDX-License-Identifier: Apache-2.0
// FittedMoments computes the moments of the samples in each triangle of a mesh against the plane
// through the heights at its corners, from which fittedCorrections() fits these heights.
//
// They are the moments of gains/moments.hpp, but the heights h at the vertices need not be samples.
// The samples at vertices belong to no triangle: a vertex adds the error z - h of its own sample.
// When a vertex is removed, its sample goes to the triangles on either side of the edge that it
// split, half to each. Coarsening the mesh merges triangles upwards, so that all stages of a
// decimation together cost one descent over the surface.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "codec/mesh/gains/moments.hpp"
#include "codec/mesh/surface/weighted_surface.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline fitting {

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

}  // namespace tetrakis::inline fitting
