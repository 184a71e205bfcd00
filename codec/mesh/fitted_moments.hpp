// SPDX-License-Identifier: Apache-2.0
// Moments of the triangles of one mesh against planes through heights of one's choice.
//
// As in moments.hpp, but corners need not lie on the surface: heights h at the vertices are free.
// The samples at vertices stand apart (a vertex errs by z - h on its own sample, and no triangle
// counts it); a vertex that goes leaves its sample to the triangles on either side of its split
// edge, half each. Coarsening the mesh merges triangles upwards, so that all stages of a decimation
// together cost one descent over the surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "codec/mesh/lattice.hpp"
#include "codec/mesh/moments.hpp"
#include "codec/mesh/surface_view.hpp"

namespace tetrakis {

/// A surface whose samples may be unknown: known[i] == 0 takes sample i out of fits, whatever its
/// weight in the view; empty: all are known.
struct WeightedSurface {
  SurfaceView view;
  std::span<const uint8_t> known = {};

  bool isWeighted() const { return !known.empty() || !view.weights.empty(); }
  double weightOf(uint32_t sample) const {
    return known.empty() || known[sample] != 0 ? view.weightOf(sample) : 0;
  }
};

class FittedMoments {
 public:
  /// corners: samples of a, b, apex.
  struct Leaf {
    std::array<uint32_t, 3> corners;
    TriangleMoments moments;
  };

  /// The mesh of all vertices, with the samples as heights. lattice and surface outlive this.
  FittedMoments(const Lattice& lattice, const WeightedSurface& surface);

  /// Removes all vertices of the mesh but `kept`, a closed set.
  void coarsen(std::span<const VertexId> kept);
  /// Adds corrections[i] to the height at samples[i], each a vertex of the mesh.
  void correct(std::span<const uint32_t> samples, std::span<const double> corrections);

  /// Triangles of the mesh after the first coarsen(), in the order of meshOf().
  const std::vector<Leaf>& leaves() const { return leaves_; }
  /// Of the mesh at the sample of one of its vertices.
  double height(uint32_t sample) const { return heights_[sample]; }
  const WeightedSurface& surface() const { return surface_; }

  /// What each of `vertices`, those of the mesh, saves with these heights (gains.hpp). After the
  /// first coarsen().
  std::vector<double> gains(std::span<const VertexId> vertices) const;

 private:
  friend class FittedDescent;

  const Lattice& lattice_;
  WeightedSurface surface_;
  std::vector<bool> present_;    ///< of each lattice vertex
  std::vector<double> heights_;  ///< of each sample; those of vertices count
  std::vector<Leaf> leaves_;
  /// Of triangles that overhang the grid, against planes through their samples, by split vertex and
  /// side: rasterised once.
  mutable std::unordered_map<uint64_t, TriangleMoments> rasters_;
  bool full_ = true;  ///< all leaves are of full resolution, empty, and not stored
};

}  // namespace tetrakis
