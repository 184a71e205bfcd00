// SPDX-License-Identifier: Apache-2.0
// closureSlopes() computes from the gains of vertices the best 4-8 meshes of a surface, which no
// order of decimation can beat: the corners of the lower convex hull of all its meshes.
//
// By the diamond form of the error (gains/gains.hpp) the mesh of a closed set S has D + lambda R =
// constant - sum over S of (g - lambda c): for one lambda the best mesh is a maximum closure of the
// parent graph. Over all lambda the best sets are nested, so each vertex has one slope at which it
// enters: x(v) >= x(child of v). These x are the isotonic regression of g / c with weights c
// (Barlow and Brunk 1972; Picard 1976), found by halving (Spouge, Wan and Wilbur 2003): a part of
// the graph whose maximum closure at its own mean slope is trivial has that slope, and any other
// falls into the closure and the rest, which never look at each other again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/surface/surface_view.hpp"

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline closure {

/// Returns for each vertex the slope lambda, in squared height steps a triangle, at which it enters
/// the best mesh: {v : slope > lambda} is closed and minimises D + lambda R for every lambda that
/// is no slope. A slope is never greater than those of the parents. It is +infinity or -infinity
/// for a vertex that costs no triangles and gains or loses. vertices: a closed set, ids ascending;
/// gains: one for each of them, e.g. of vertexGains(). Gains are rounded to multiples of 2^-58 of
/// the sum of their absolute values, so slopes that differ by less may be taken for one.
std::vector<double> closureSlopes(const Lattice& lattice, std::span<const VertexId> vertices,
                                  std::span<const double> gains);

/// Whether the best meshes around a number of triangles hold a vertex. The corners of the hull on
/// either side of that number are meshes; parents have no smaller value than their children.
namespace hull_side {
inline constexpr double kWithin = 2;  ///< in the last corner that has no more triangles than that
inline constexpr double kAcross = 1;  ///< in the next corner only
inline constexpr double kBeyond = 0;  ///< in neither of the two
}  // namespace hull_side

/// Returns the side of each vertex, in a small part of the time of closureSlopes(). vertices and
/// gains are as for that function.
std::vector<double> hullSides(const Lattice& lattice, std::span<const VertexId> vertices,
                              std::span<const double> gains, uint32_t triangles);

/// The same vertices by their ids.
std::vector<VertexId> ascending(std::span<const VertexId> order);

/// Sorts the vertices of an order by falling keys; those with equal keys stay in their order.
/// vertices: the same by their ids; keys: one for each of them.
void sortByKeys(std::span<const VertexId> vertices, std::span<const double> keys,
                std::span<VertexId> order);

/// Sorts a closed set, the first vertices of an order, so that its prefixes pass through every
/// corner of the hull of the meshes within it; between corners they keep their order. gains: of all
/// lattice vertices.
void sortThroughCorners(const Lattice& lattice, const std::vector<double>& gains,
                        std::span<VertexId> order);

}  // namespace tetrakis::inline closure
