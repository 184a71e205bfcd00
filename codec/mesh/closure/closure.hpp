// SPDX-License-Identifier: Apache-2.0
// ClosureFlow finds maximum closures of parts of the parent graph by a preflow that climbs from
// finer to coarser vertices (Picard 1976: closure as minimum cut; Goldberg and Tarjan 1988:
// push-relabel; Hochbaum 2008: excess and deficit at vertices instead of source and sink).
//
// Vertex v has the weight w(v). A vertex with an excess may lend any amount of it to its parents,
// and a parent may give back what it was lent: a residual arc child -> parent always exists, an arc
// parent -> child while the loan f > 0. e(v) = w(v) + received - lent. Once no vertex with e > 0
// reaches one with e < 0, the vertices that reach no deficit are a maximum closure: they hold their
// parents, no loan crosses their border, and so their weights sum to their e >= 0 while all e
// outside are <= 0.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "codec/mesh/surface/surface.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline closure {

/// Loans along the arcs of the parent graph. They are kept from one problem to the next, which then
/// starts close to its solution. Every vertex belongs to one part; arcs between parts do not exist.
class ClosureFlow {
 public:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  /// Parents of a vertex; kNone where there are fewer. No vertex is a parent of more than four.
  using Arcs = std::array<uint32_t, 2>;

  /// Begins with all vertices in part 0 and without loans.
  explicit ClosureFlow(std::vector<Arcs> parents);

  /// Solves one part. weights: w of each vertex of `part`, in its order; any sum of absolute values
  /// fits 62 bits. Afterwards inClosure() tells its maximum closure, the largest if there are
  /// several, and no loan crosses the closure's border.
  void solve(std::span<const uint32_t> part, std::span<const int64_t> weights);
  bool inClosure(uint32_t v) const { return label_[v] == kUnreached; }

  /// Moves the vertices of one part into connected parts of its closure and of the rest, and
  /// reorders them so that each is contiguous; returns their ends.
  std::vector<size_t> split(std::span<uint32_t> part);

 private:
  static constexpr uint32_t kUnreached = std::numeric_limits<uint32_t>::max();
  using Children = std::array<uint32_t, 4>;

  template <class Visit>
  void forEachParent(uint32_t v, Visit&& visit) const;
  template <class Visit>
  void forEachChild(uint32_t v, Visit&& visit) const;

  void setExcess(std::span<const uint32_t> part, std::span<const int64_t> weights);
  void label(std::span<const uint32_t> part);
  void discharge(uint32_t v);
  void pushTo(uint32_t to, int64_t amount);
  uint32_t labelAboveNeighbours(uint32_t v) const;

  std::vector<Arcs> parents_;
  std::vector<Children> children_;
  std::vector<std::array<int64_t, 2>> loans_;  ///< from each vertex to its parents
  std::vector<int64_t> excess_;
  std::vector<uint32_t> label_;  ///< lower bound of the arcs to the nearest deficit
  std::vector<uint32_t> part_;
  uint32_t part_count_ = 1;
  std::vector<uint32_t> queue_;   ///< of label(): breadth first
  std::vector<uint32_t> active_;  ///< e > 0, to be discharged in the next round
  std::vector<uint32_t> round_;
  size_t relabels_ = 0;  ///< since the last label()
};

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

/// Vertices by their numbers, parents before children, and the triangles that each of them costs.
struct ClosureGraph {
  std::vector<ClosureFlow::Arcs> parents;
  std::vector<uint8_t> costs;
};

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

/// The same of any graph. triangles: beyond those of the mesh without vertices.
std::vector<double> hullSides(ClosureGraph graph, std::span<const double> gains, int64_t triangles);

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
