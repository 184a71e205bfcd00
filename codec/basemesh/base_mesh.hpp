// SPDX-License-Identifier: Apache-2.0
// BaseMesh is what a surface lies over: a quad for each patch of a forest, by the places of its
// corners in a grid of cubic cells. Heights of the surface count along its normals.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/forest.hpp"
#include "bitstream/stream/base_mesh_header.hpp"

namespace tetrakis::inline basemesh {

using Cell = std::array<int32_t, 3>;

struct BaseMesh {
  SharedForest forest;
  int bits = 0;  ///< coordinates of corners are 0 to 2^bits - 1
  /// Four a patch: nw, ne, se, sw. Corners that are one have one place.
  std::vector<Cell> corners;
  std::array<double, 3> origin{};  ///< of the grid, in the unit of the surface
  double cell = 1;                 ///< side of a cell, likewise
};

/// For each corner of a patch the lowest one that is at the same place.
std::vector<uint32_t> cornerOwners(const Forest& forest);

/// Any codeword is that of a mesh: what its bytes do not tell is as it is expected.
BaseMesh decodeBaseMesh(const BaseMeshHeader& header, const SharedForest& forest);

/// (Encoder)
BaseMeshHeader encodeBaseMesh(const BaseMesh& mesh);

}  // namespace tetrakis::inline basemesh
