// SPDX-License-Identifier: Apache-2.0
// CodedTriangles is a mesh of triangles whose vertices, and coordinates on a texture, are whole
// numbers: what a stream holds of an object that is coded as it is, which suits designed parts and
// models of few triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bitstream/stream/triangle_mesh_header.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline trianglemesh {

inline constexpr uint32_t kBorder = UINT32_MAX;  ///< of a side: no other triangle lies there

using Place = std::array<int32_t, 3>;
using Texcoord = std::array<int32_t, 2>;

/// Corner 3t + i of triangle t is where its side 3t + i begins, counter-clockwise seen from
/// outside. The side ends at the corner behind it.
struct CodedTriangles {
  std::vector<uint32_t> sides;     ///< the one that each is glued to, or kBorder
  std::vector<uint32_t> vertices;  ///< of each corner
  std::vector<Place> places;       ///< of each vertex
  std::vector<uint32_t> cut;       ///< the sides, with seams of the texture as borders; or empty
  std::vector<uint32_t> wedges;  ///< of each corner: corners of one vertex, without a seam between
  std::vector<Texcoord> texcoords;  ///< of each wedge
};

/// The corner, or side, behind another one of the same triangle.
inline uint32_t after(uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}
inline uint32_t before(uint32_t corner) {
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// TKS_CORRUPT where the codeword breaks a rule or ends early. Takes up to 250 bytes a triangle,
/// and time in proportion to these.
Result<CodedTriangles> decodeTriangles(const TriangleMeshHeader& header);

}  // namespace tetrakis::inline trianglemesh
