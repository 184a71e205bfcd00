// SPDX-License-Identifier: Apache-2.0
// Makes better quads of matched triangles by exchanges among a few neighbours.
#pragma once

#include <cstddef>

#include "codec/remesh/cubic_matching.hpp"
#include "codec/remesh/pair_graph.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

constexpr size_t kExchangedPairs = 12;  ///< at most

/// Looks for cycles of neighbours that are pairs, gap, pair, gap and so on, in which pairs and gaps
/// may change places; and for paths of that kind from a triangle alone to one that may be alone in
/// its stead. Follows them only as long as what they have exchanged so far is a gain (Lin and
/// Kernighan, 1973): every cycle that gains can be walked in that way, from one of its pairs. Takes
/// the best exchange of each triangle while one lowers the badness of quads and points in all. As
/// many triangles are alone, and as many have no mates, as before.
void exchangePairs(const TriangleMesh& mesh, const PairGraph& graph, Matching& matching);

/// Of a point inside the mesh where so many quads meet: four are good, two share two sides.
double pointBadness(int quads);

}  // namespace tetrakis::inline remesh
