// SPDX-License-Identifier: Apache-2.0
// TriangleMeshHeader is the part of a header that holds a mesh of triangles as they are:
// codec/trianglemesh/coded_triangles.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace tetrakis::inline stream {

struct TriangleMeshHeader {
  static constexpr uint64_t kMostTriangles = 1u << 20;
  static constexpr uint8_t kMostPlaceBits = 20, kMostTexcoordBits = 20, kMostFraction = 24;
  static constexpr int64_t kMostOrigin = int64_t{1} << 50;
  static constexpr int64_t kMostTexcoordOrigin = 1 << 30;

  uint64_t triangles = 0;  ///< 0: there is no mesh
  uint8_t place_bits = 1;  ///< places of vertices are 0 to 2^place_bits - 1, from the origin
  double cell = 1;         ///< side of a cell of their grid
  std::array<int64_t, 3> origin{};           ///< of the grid, in cells
  uint8_t texcoord_bits = 0;                 ///< likewise of texture coordinates; 0: there are none
  uint8_t texcoord_fraction = 0;             ///< they count in units of 2^-texcoord_fraction
  std::array<int64_t, 2> texcoord_origin{};  ///< in these
  std::string code;                          ///< codeword of all

  bool none() const { return triangles == 0; }

  template <class V>
  void visit(V& v) {
    v.varint("mesh_triangles", triangles, 1, kMostTriangles);
    v.u8("place_bits", place_bits, 1, kMostPlaceBits);
    v.f64("cell", cell);
    v.require("cell", cell > 0);
    for (int64_t& cells : origin) v.zigzag("origin", cells, kMostOrigin);
    v.u8("texcoord_bits", texcoord_bits, 0, kMostTexcoordBits);
    if (texcoord_bits > 0) {
      v.u8("texcoord_fraction", texcoord_fraction, 0, kMostFraction);
      for (int64_t& units : texcoord_origin)
        v.zigzag("texcoord_origin", units, kMostTexcoordOrigin);
    }
    v.rest(code);
  }
};

}  // namespace tetrakis::inline stream
