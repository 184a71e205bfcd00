// SPDX-License-Identifier: Apache-2.0
// Made triangle meshes of known topology, and a check of what a manifold is that uses no code of
// the library. All that are closed look outwards.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::made {

/// An octahedron whose triangles are halved `levels` times in each direction: 8 * 4^levels.
TriangleMesh sphere(int levels);

/// `around` * `across` * 2 triangles; radii 1 and 0.4.
TriangleMesh torus(uint32_t around, uint32_t across);

/// `width` * `height` * 2 triangles over [0, 1]² with waves of amplitude `bump`; one boundary.
TriangleMesh openGrid(uint32_t width, uint32_t height, double bump = 0.1);

/// A sphere with six thin limbs, four radii long.
TriangleMesh sphereWithLimbs(int levels);

/// An open pipe of `around` * `along` * 2 triangles: two boundaries.
TriangleMesh pipe(uint32_t around, uint32_t along);

/// A strip with half a twist, which has one side only; 2 * `along` triangles.
TriangleMesh moebiusStrip(uint32_t along);

/// `count` triangles between any of `points` points of a small grid: as bad as meshes get.
TriangleMesh soup(std::mt19937& random, uint32_t points, uint32_t count);

/// Both meshes, the second one moved by `offset`.
TriangleMesh beside(const TriangleMesh& a, const TriangleMesh& b, const Point& offset);

/// Why the mesh isn't an oriented manifold with boundary whose points are all used; empty if it is.
std::string manifoldFault(const TriangleMesh& mesh);

}  // namespace tetrakis::made
