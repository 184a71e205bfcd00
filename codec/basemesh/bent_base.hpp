// SPDX-License-Identifier: Apache-2.0
// BentBase bends the quads of a base mesh by the normals at their corners: each edge is a cubic
// that leaves its ends at right angles to their normals (C. Hermite), and each patch is filled in
// between its edges (S. A. Coons, "Surfaces for computer-aided design of space forms", 1967).
// Patches that share an edge agree on it, since the edge depends on its ends alone. The heights of
// a surface count along normals that lie between those of the corners.
//
// All is computed in integers, so that every decoder has the same bits:
//
//   places    cells of the base mesh in units of 2^-8
//   normals   2^14 long, each coordinate rounded
//   u, v      a sample is i / n and j / n of the way along a patch, n = 2^depth, depth <= 8
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codec/basemesh/base_mesh.hpp"

namespace tetrakis::inline basemesh {

using Vector = std::array<int64_t, 3>;

/// A point of the base and its normal, in units as above. The normal is 0 where there is none.
struct BasePoint {
  Vector place, normal;
};

class BentBase {
 public:
  static constexpr int kPlaceBits = 8, kNormalBits = 14;

  /// mesh: with patches of depth BaseMeshHeader::kMostDepth at most.
  explicit BentBase(const BaseMesh& mesh);

  /// Of all samples of a patch, row by row. Samples that patches share come out alike.
  std::vector<BasePoint> patch(uint32_t patch) const;

 private:
  /// Point k of n + 1 on the edge from one corner to another. It is computed from the corner of the
  /// lower owner, since roundings depend on the direction.
  Vector edgePoint(uint32_t from, uint32_t to, int64_t k) const;

  const BaseMesh& mesh_;
  int64_t n_;
  std::vector<uint32_t> owners_;
  std::vector<Vector> normals_;  ///< of the corners
};

/// Where a sample of a surface lies, in the unit of its heights: `height` along the normal.
std::array<double, 3> placeOf(const BaseMesh& mesh, const BasePoint& base, double height);

}  // namespace tetrakis::inline basemesh
