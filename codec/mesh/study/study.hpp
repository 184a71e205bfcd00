// SPDX-License-Identifier: Apache-2.0
// decimate() with a policy, and MeshHull with the best meshes of all, take a surface and return the
// orders of vertices with which the thesis compares general decimation. Only tests and bench/ link
// this folder.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/closure/closure.hpp"
#include "codec/mesh/decimation/decimation.hpp"
#include "codec/mesh/decimation/worth.hpp"
#include "codec/mesh/surface/surface.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline study {

// localErrors() computes for every vertex the error of its own sample, by which meshes without
// global error are chosen (thesis 2.5.2: errors at the knots alone).

/// For every vertex, the squared error of its own sample, times its weight, in a mesh that has the
/// vertex's parents and not the vertex; 0 for hidden ones. The surface has the lattice's size.
std::vector<double> localErrors(const Lattice& lattice, const SurfaceView& surface);

// restrictedDecimation() and refinement() order single vertices by fixed slopes. The thesis
// compares general decimation with these orders (2.5.2, 5.4.2, 5.5.2).

/// Refinement: from the roots up, each step inserts the vertex of greatest slope among those whose
/// parents are there; what costs nothing first. All vertices, in this order.
std::vector<VertexId> refinement(const std::vector<double>& errors, const VertexCosts& costs);

// decimate() orders the vertices of a surface by any of the policies that the thesis compares
// (2.5.2, 5.4.2, 5.5.2), with costs of any kind. The library itself decimates in one way
// (codec/mesh/decimation/decimation.hpp).

/// How the next vertex is chosen.
enum class MeshPolicy {
  kNearHull,              ///< that of the library; with costs the same as kGeneralDecimation
  kGeneralDecimation,     ///< whole merging domains, global error (decimation.hpp)
  kRestrictedDecimation,  ///< single vertices, global error (study.hpp; thesis 5.4.2)
  kLocalDecimation,       ///< single vertices, error at the vertex alone (thesis 2.5.2, 5.5.2)
  kLocalRefinement,       ///< insertion from the roots, likewise (thesis 2.5.2, 5.5.2)
};

struct DecimationOptions {
  MeshPolicy policy = MeshPolicy::kNearHull;
  /// One for each lattice vertex, in any unit (worth.hpp); empty: triangles.
  std::span<const uint32_t> costs;
};

/// Orders all vertices of a surface by a policy. Fails with the errors of decimate(surface), with
/// TKS_USAGE for costs that are not one for each vertex, and with TKS_LIMIT for costs that add up
/// to 2^32 or more.
Result<MeshSequence> decimate(const SurfaceView& surface, const DecimationOptions& options);

// MeshHull is the lower convex hull of all 4-8 meshes of a surface
// (codec/mesh/closure/closure.hpp), which no order of decimation can beat. decimateOptimally()
// gives an order through all of its corners.

/// The slopes of closureSlopes() for the set of all lattice vertices.
std::vector<double> closureSlopes(const Lattice& lattice, std::span<const double> gains);

/// Corners of the hull, from the roots alone to full resolution.
class MeshHull {
 public:
  struct Corner {
    uint32_t triangles = 0;
    double squared_error = 0;
  };

  MeshHull(const Lattice& lattice, const std::vector<double>& gains,
           const std::vector<double>& slopes);

  const std::vector<Corner>& corners() const { return corners_; }
  /// No mesh of at most `triangles` triangles has less squared error. Not below the roots'
  /// triangles.
  double bound(uint32_t triangles) const;

 private:
  std::vector<Corner> corners_;
};

/// Like decimate(), but through every corner of the hull; between corners in greedy order.
Result<MeshSequence> decimateOptimally(const SurfaceView& surface);

}  // namespace tetrakis::inline study
