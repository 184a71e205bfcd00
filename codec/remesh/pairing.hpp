// SPDX-License-Identifier: Apache-2.0
// paired() pairs the triangles of a base mesh to quads. If triangles at the border may stay alone,
// an oriented mesh can always be paired so that no triangle is left over. To see this, glue the
// mesh to its mirror image along the border. The result is closed, and no two parts of it hold
// together by one side alone, since a side has two ends. So its triangles are a cubic graph without
// bridges, which has a perfect matching (Petersen, 1891).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// A quad by its four different points, counter-clockwise from outside, and its two triangles. The
/// first triangle has the corners 0, 1, 2 of the quad and the second one 0, 2, 3, in this order.
struct Quad {
  std::array<uint32_t, 4> corners{};
  std::array<uint32_t, 2> triangles{};
};

/// A triangle that is a part of triangle `triangle` of another mesh. Its corners are given by their
/// weights in that triangle.
struct TrianglePart {
  uint32_t triangle = 0;
  std::array<std::array<double, 3>, 3> corners{};
};

struct PairedMesh {
  TriangleMesh mesh;        ///< its points: those of the base, then the middles of halved sides
  std::vector<Quad> quads;  ///< quad q has the triangles 2 q and 2 q + 1
  std::vector<TrianglePart> parts;  ///< where each triangle lies on the base
};

/// Pairs triangles so that the quads are near to flat squares: it starts with the best pairs and
/// improves them by exchanges among neighbours. As few triangles as possible stay alone, all of
/// them at the border. Such a triangle becomes a quad by the middle of one of its sides at the
/// border, where the quad has an angle of 180 degrees.
/// `base` is an oriented manifold whose triangles have three different corners. Other meshes give
/// quads as well: a side counts as border unless exactly one other triangle has it, in the opposite
/// direction.
PairedMesh paired(const TriangleMesh& base);

/// The place on the base of a place on `paired.mesh`.
SurfacePoint onBase(const PairedMesh& paired, const SurfacePoint& place);

}  // namespace tetrakis::inline remesh
