// SPDX-License-Identifier: Apache-2.0
// Pairs the triangles of a base mesh to quads. In an oriented mesh there is always a way that
// leaves none over, if triangles at the border may stay alone: glued to its mirror image along the
// border the mesh is closed, and no single side, since it has two ends, is all that holds two parts
// of it together. Cubic graphs without such bridges have perfect matchings (Petersen, 1891).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// The points `corners`, counter-clockwise from outside, all different. The first of the
/// `triangles` has the corners 0 1 2 of the quad, the second 0 2 3, each in that order.
struct Quad {
  std::array<uint32_t, 4> corners{};
  std::array<uint32_t, 2> triangles{};
};

/// A triangle that is a part of a triangle of another mesh: by the weights there of its corners.
struct TrianglePart {
  uint32_t triangle = 0;
  std::array<std::array<double, 3>, 3> corners{};
};

struct PairedMesh {
  TriangleMesh mesh;                ///< points: those of the base, then middles of halved sides
  std::vector<Quad> quads;          ///< quad q has the triangles 2 q and 2 q + 1
  std::vector<TrianglePart> parts;  ///< of each triangle: where it lies on the base
};

/// Quads that are as near to flat squares as good pairs, and exchanges among some neighbours, make
/// them. Of triangles at the border as few as possible are alone: such a one becomes a quad by the
/// middle of a side at the border, where the quad has an angle of 180 degrees. `base` is oriented
/// and manifold, its triangles have three different corners. Other meshes give quads as well: sides
/// that no other triangle, or more than one, has in the opposite sense count as border.
PairedMesh paired(const TriangleMesh& base);

/// The place on the base of a place on `paired.mesh`.
SurfacePoint onBase(const PairedMesh& paired, const SurfacePoint& place);

}  // namespace tetrakis::inline remesh
