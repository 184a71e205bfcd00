// SPDX-License-Identifier: Apache-2.0
// fewerTriangles() leaves at most so many triangles of a mesh: vertices collapse into neighbours,
// the cheapest one first (swept_error.hpp), so that each vertex that is left lies where it did, and
// has texture coordinates that it had.
//
// A piece is what hangs together. At first its collapses keep its shape and its texture as well as
// the surface. Where no such collapse is left, any that keeps the surface will do. In the end the
// piece vanishes as a whole, since the crumbs of a scan may be more than the triangles of a small
// budget; of the last piece the largest triangles are left. All pieces are in one line by what
// their next step costs, so that crumbs go long before a large piece loses its shape.
#pragma once

#include <cstdint>

#include "codec/trianglemesh/coded_triangles.hpp"
#include "codec/trianglemesh/collapsing_triangles.hpp"

namespace tetrakis::inline trianglemesh {

/// mesh: as decoded; most: 1 or more. Returns a mesh without cut sides, whose vertices and wedges
/// are numbered by first use. No edge opens, but where `most` is below what the last piece needs (a
/// ball four triangles, a ring some ten). Takes a time of n log n, and up to 300 bytes a triangle,
/// the mesh among them.
CodedTriangles fewerTriangles(CodedTriangles mesh, uint64_t most);

/// The same triangles by the numbers that they and their vertices have in the mesh.
LeftTriangles leftTriangles(CodedTriangles mesh, uint64_t most);

}  // namespace tetrakis::inline trianglemesh
