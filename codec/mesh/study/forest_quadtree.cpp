// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/study/forest_quadtree.hpp"

#include <algorithm>
#include <cassert>

#include "codec/mesh/quadtree/mesh_tree.hpp"

namespace tetrakis::inline study {

namespace {

/// Nodes store the midpoints of these sides.
bool inNodes(Heading side) {
  return side == Heading::kNorth || side == Heading::kWest;
}

/// Of two sides that are one, or of a border, the one whose patch stores the vertices.
bool keeps(uint32_t side, uint32_t other) {
  if (other == Forest::kBorder) return true;
  const bool here = inNodes(turned(Heading::kNorth, side));
  return here == inNodes(turned(Heading::kNorth, other)) ? side < other : here;
}

/// A midpoint of the side of a node, where the patch stores it.
QuadtreePlace placeWithin(const ForestAdjacency& adjacency, const Square& square, Heading side) {
  const auto [level, column, row] = square;
  const uint32_t last = (1u << level) - 1;
  QuadtreePlace place;
  place.level = static_cast<uint8_t>(level);
  if (side == Heading::kEast && column == last) {
    place.tree = QuadtreePlace::kEastBorder;
    place.node = row;
    return place;
  }
  if (side == Heading::kSouth && row == last) {
    place.tree = QuadtreePlace::kSouthBorder;
    place.node = column;
    return place;
  }
  const bool is_row = side == Heading::kNorth || side == Heading::kSouth;
  place.vertex = is_row ? kNorth : kWest;
  place.node = adjacency.differences().shape().nodeOf(
      {level, column + (side == Heading::kEast ? 1 : 0), row + (side == Heading::kSouth ? 1 : 0)});
  return place;
}

bool atSide(const Square& square, Heading side) {
  const uint32_t last = (1u << square.level) - 1;
  if (side == Heading::kNorth) return square.row == 0;
  if (side == Heading::kEast) return square.column == last;
  if (side == Heading::kSouth) return square.row == last;
  return square.column == 0;
}

/// The side of the patch that a vertex of its quadtree lies on, if it does.
std::optional<Heading> sideOf(const QuadtreeShape& shape, const QuadtreePlace& place) {
  if (place.tree == QuadtreePlace::kEastBorder) return Heading::kEast;
  if (place.tree == QuadtreePlace::kSouthBorder) return Heading::kSouth;
  const Square square = shape.squareOf(place.level, place.node);
  if (place.vertex == kNorth && square.row == 0) return Heading::kNorth;
  if (place.vertex == kWest && square.column == 0) return Heading::kWest;
  return std::nullopt;
}

}  // namespace

ForestAdjacency::ForestAdjacency(const Forest& forest)
    : codes_{static_cast<uint32_t>(forest.depth()), forest.patches(), 1},
      differences_(QuadtreeShape{codes_.depth}) {
  assert(codes_.depth <= 16 && uint64_t{forest.patches()} << 2 * codes_.depth <= 3ull << 32);
  for (uint32_t side = 0; side < forest.sides().size(); ++side) {
    const uint32_t other = forest.sides()[side];
    Crossing& over = crossings_.emplace_back();
    over.keeps = keeps(side, other);
    if (other == Forest::kBorder) continue;
    const uint32_t s = side % Forest::kSides, t = other % Forest::kSides;
    over.patch = other / Forest::kSides;
    over.side = static_cast<Heading>(t);
    over.quarters = static_cast<uint8_t>((t + 6 - s) % 4);
    over.reversed = (s < 2) == (t < 2);
  }
}

ForestPlace centreOf(const ForestAdjacency& adjacency, const ForestNode& node) {
  const uint32_t local = adjacency.differences().shape().nodeOf(node.square);
  return {node.patch,
          {static_cast<uint8_t>(node.square.level), QuadtreePlace::kNodes, kCentre, local}};
}

ForestPlace midpointOf(const ForestAdjacency& adjacency, const ForestNode& node, Heading side) {
  const ForestAdjacency::Crossing& over = adjacency.crossing(node.patch, side);
  if (!atSide(node.square, side) || over.keeps)
    return {node.patch, placeWithin(adjacency, node.square, side)};
  ForestTraversal beyond(adjacency, node);
  beyond.step(side);
  return {over.patch, placeWithin(adjacency, beyond.node().square, over.side)};
}

uint32_t borderTrees(const ForestAdjacency& adjacency) {
  uint32_t count = 0;
  for (uint32_t patch = 0; patch < adjacency.patches(); ++patch)
    for (const Heading side : {Heading::kEast, Heading::kSouth})
      count += adjacency.crossing(patch, side).keeps ? 1 : 0;
  return count;
}

ForestQuadtree::ForestQuadtree(const ForestLattice& lattice, std::span<const ForestVertex> vertices,
                               std::span<const float> heights)
    : adjacency_(lattice.forest()) {
  const Forest& forest = lattice.forest();
  const QuadtreeShape shape{adjacency_.depth()};
  const size_t side = forest.side(), last = side - 1;
  std::vector<uint8_t> in(lattice.vertexCount());
  for (const ForestVertex v : vertices) in[v] = 1;
  for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
    const size_t first = patch * side * side;
    const float roots[] = {heights[first], heights[first + last], heights[first + last * side],
                           heights[first + last * side + last]};
    std::vector<SemilinearQuadtree::Entry> entries;
    lattice.patch().forEachVertex([&](Site site, VertexId local) {
      const ForestVertex v = lattice.vertex(patch, local);
      if (in[v] == 0) return;
      const QuadtreePlace place = placeOf(lattice.patch(), site);
      const std::optional<Heading> border = sideOf(shape, place);
      if (border && !adjacency_.crossing(patch, *border).keeps) return;
      entries.push_back({place, heights[lattice.sample(v)]});
    });
    trees_.emplace_back(shape, roots).update(std::move(entries), {});
  }
}

uint32_t ForestQuadtree::vertexCount() const {
  uint32_t count = 0;
  for (const SemilinearQuadtree& tree : trees_) count += tree.vertexCount() - tree.rootCount();
  return count;
}

std::optional<float> ForestQuadtree::find(const ForestPlace& place) const {
  const SemilinearQuadtree& tree = trees_[place.patch];
  const uint32_t number = tree.find(place.place);
  if (number == kNoVertex) return std::nullopt;
  return tree.values()[number];
}

std::optional<ForestNode> ForestQuadtree::locate(uint32_t patch, double x, double y) const {
  const uint32_t depth = adjacency_.depth(), last = (1u << depth) - 1;
  const uint32_t column = std::min(static_cast<uint32_t>(x), last);
  const uint32_t row = std::min(static_cast<uint32_t>(y), last);
  std::optional<ForestNode> deepest;
  for (uint32_t level = 0; level < depth; ++level) {
    const ForestNode node{patch, {level, column >> (depth - level), row >> (depth - level)}};
    if (!has(node)) break;
    deepest = node;
  }
  return deepest;
}

size_t ForestQuadtree::bytes() const {
  size_t bytes = 0;
  for (const SemilinearQuadtree& tree : trees_) bytes += tree.bytes();
  return bytes;
}

}  // namespace tetrakis::inline study
