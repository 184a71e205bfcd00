// SPDX-License-Identifier: Apache-2.0
// TriangleEncoder rounds the corners of a mesh to a grid, and its texture coordinates to parts of
// texels, and codes it. One mesh can be coded on several grids.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/trianglemesh/coded_triangles.hpp"

namespace tetrakis::inline trianglemesh {

/// A mesh that is an oriented manifold with boundary. All but the sides outlives the encoder.
struct PlainMesh {
  std::span<const std::array<double, 3>> points;       ///< finite
  std::span<const std::array<uint32_t, 3>> triangles;  ///< one or more
  std::vector<uint32_t> sides;  ///< of each side, 3t + i, the one that it is glued to, or kBorder
  /// Three pairs a triangle, or none. Whole numbers more or less are the same place of a texture;
  /// what is not finite, or beyond 2^18, lies anywhere.
  std::span<const std::array<std::array<float, 2>, 3>> texcoords;
};

class TriangleEncoder {
 public:
  /// texcoord_fraction: texture coordinates are rounded to multiples of 2^-texcoord_fraction, or
  /// more coarsely where they take more than kMostTexcoordBits.
  TriangleEncoder(const PlainMesh& mesh, uint8_t texcoord_fraction);

  /// Corners on a grid of so many places along the longest side of the box around the mesh.
  /// places: 3 to 2^kMostPlaceBits.
  TriangleMeshHeader encode(uint32_t places) const;

  /// For each corner of the coded mesh the corner of the given mesh that it was.
  const std::vector<uint32_t>& givenCorners() const { return given_; }

 private:
  void numberTriangles();
  void cutSeams();
  void roundTexcoords(uint8_t fraction);
  std::array<float, 2> texcoordAt(uint32_t corner) const;
  std::vector<std::array<int64_t, 2>> roundedTexcoords(int fraction) const;

  PlainMesh mesh_;
  std::vector<uint32_t> given_;          ///< of each corner of the coded mesh the one that it was
  std::vector<uint32_t> first_corners_;  ///< one of each vertex
  CodedTriangles coded_;                 ///< all but places
  TriangleMeshHeader header_;            ///< what does not depend on the grid
};

}  // namespace tetrakis::inline trianglemesh
