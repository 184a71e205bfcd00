// SPDX-License-Identifier: Apache-2.0
// MeshHull is the lower convex hull of all 4-8 meshes of a surface
// (codec/mesh/closure/closure.hpp), which no order of decimation can beat. decimateOptimally()
// gives an order through all of its corners.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/closure/closure.hpp"
#include "codec/mesh/decimation/decimation.hpp"

namespace tetrakis::inline study {

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
