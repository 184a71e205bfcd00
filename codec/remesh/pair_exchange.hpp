// SPDX-License-Identifier: Apache-2.0
// exchangePairs() improves the quads of matched triangles by exchanges among a few neighbours.
#pragma once

#include "codec/remesh/cubic_matching.hpp"
#include "codec/remesh/pair_graph.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// Looks for cycles of neighbours in which every other side is a pair. If such a cycle is
/// exchanged, its other sides become the pairs. Also looks for such paths from a triangle that is
/// alone to one that may be alone in its stead. A cycle or path is followed only as long as the
/// exchange is a gain up to there (Lin and Kernighan, 1973). No cycle that gains is missed, since
/// it can be followed in this way from at least one of its pairs. For each triangle the best
/// exchange is made if it lowers the total badness of quads and points. As many triangles as before
/// are alone, and as many have no mate.
void exchangePairs(const TriangleMesh& mesh, const PairGraph& graph, Matching& matching);

/// The badness of a point inside the mesh where so many quads meet. Four are good. Two are bad,
/// since they share two sides.
double pointBadness(int quads);

}  // namespace tetrakis::inline remesh
