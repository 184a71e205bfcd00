// SPDX-License-Identifier: Apache-2.0
// MeshArrays holds the arrays of a mesh that is to be compressed, and positionSteps() tells how
// finely each axis is kept.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace tetrakis::tools {

/// Of n vertices. Indices are below n; there is a vertex and a triangle.
struct MeshArrays {
  std::span<const float> positions;     ///< 3 n
  std::span<const float> normals;       ///< 3 n, of length 1
  std::span<const float> texcoords;     ///< 2 n in [0, 1], or none
  std::span<const uint32_t> triangles;  ///< 3 a triangle
};

struct MeshBounds {
  std::array<float, 3> low{}, high{};
};

/// Of one vertex or more.
MeshBounds meshBounds(std::span<const float> positions);

/// The steps that positions are rounded to, finer than these: horizontally (x, z) 1/65535 of the
/// longer side, which a vertex on a grid of up to as many samples bears; heights (y) 1/16383 of
/// their range, but no finer than 1/16 of the horizontal step, where coders would store noise.
struct PositionSteps {
  double horizontal = 0, vertical = 0;  ///< 0: all coordinates of these axes are equal
};
PositionSteps positionSteps(const MeshBounds& bounds);

}  // namespace tetrakis::tools
