// SPDX-License-Identifier: Apache-2.0
// SemilinearQuadtree numbers the vertices of a 4-8 mesh and stores each of them once (thesis 4.3.2,
// 4.5).
//
//   o---n---.   A node stores three vertices: its centre c, the midpoint n of its northern and w of
//   |   |   |   its western edge. The other two midpoints belong to the nodes south and east of it.
//   w---c---.   Where there is none, they stand in two binary trees, one for the eastern and one
//   |   |   |   for the southern border: entry 2^i - 1 + row, or column, of level i (4.25), (4.26).
//   .---.---.   Corners of patches, o, belong to no node: they are the roots.
//
// Vertices are numbered without gaps: roots, then level after level the nodes along the z-curve,
// the eastern and the southern border. In a closed set parents come before their children. There
// are no pointers and no codes, only the tiles of quadtree_level.hpp; a tree of which nothing is
// missing is one array of values.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/quadtree/location_code.hpp"
#include "codec/mesh/quadtree/quadtree_level.hpp"

namespace tetrakis::inline quadtree {

enum NodeVertex : uint32_t { kCentre = 0, kNorth = 1, kWest = 2 };

/// Where a vertex is stored; in the order of the numbers.
struct QuadtreePlace {
  enum Tree : uint8_t { kNodes, kEastBorder, kSouthBorder };

  uint8_t level = 0;
  Tree tree = kNodes;
  NodeVertex vertex = kCentre;  ///< of the node; kCentre in border trees
  uint32_t node = 0;            ///< within the level; row or column in border trees

  bool operator==(const QuadtreePlace&) const = default;
  std::strong_ordering operator<=>(const QuadtreePlace& other) const {
    return order() <=> other.order();
  }

  /// 40 bits, in the order of the numbers.
  uint64_t order() const {
    return uint64_t{level} << 36 | uint64_t{tree} << 34 | uint64_t{node} << 2 | vertex;
  }
  static constexpr uint32_t kOrderBits = 40;
};

class SemilinearQuadtree {
 public:
  struct Entry {
    QuadtreePlace place;
    float value = 0;
  };

  /// roots: values of the patches' corners, row by row, (columns + 1) * (rows + 1) of them.
  SemilinearQuadtree(QuadtreeShape shape, std::span<const float> roots);

  /// Inserts vertices (or replaces their values), erases others, and chooses the form of each level
  /// anew. A node is there if its centre is: its other vertices must not be there without it. The
  /// time is linear in the vertices of the tree and the changes. No place may be in both lists.
  void update(std::vector<Entry> inserted, std::vector<QuadtreePlace> erased);

  const QuadtreeShape& shape() const { return shape_; }
  uint32_t vertexCount() const { return static_cast<uint32_t>(values_.size()); }
  uint32_t rootCount() const { return (shape_.columns + 1) * (shape_.rows + 1); }
  std::span<const float> values() const { return values_; }  ///< by vertex number

  const QuadtreeLevel<3>& nodes(uint32_t level) const { return levels_[level].nodes; }
  /// Entry (4.25) or (4.26) less 2^i - 1: one value a row, or column, of the level.
  const QuadtreeLevel<1>& eastBorder(uint32_t level) const { return levels_[level].east; }
  const QuadtreeLevel<1>& southBorder(uint32_t level) const { return levels_[level].south; }

  /// The number of the vertex at a place; kNoVertex if there is none.
  uint32_t find(QuadtreePlace place) const;

  /// Calls visit(QuadtreePlace) for all vertices but the roots, in the order of their numbers.
  template <class Visit>
  void forEachVertex(Visit&& visit) const;

  /// The bytes of memory that values and tiles take.
  size_t bytes() const;

 private:
  struct Level {
    QuadtreeLevel<3> nodes;
    QuadtreeLevel<1> east, south;
  };

  void addLevel(uint32_t level, std::span<const Entry> entries);

  QuadtreeShape shape_;
  std::vector<Level> levels_;
  std::vector<float> values_;
};

template <class Visit>
void SemilinearQuadtree::forEachVertex(Visit&& visit) const {
  for (uint8_t level = 0; level < levels_.size(); ++level) {
    const Level& l = levels_[level];
    l.nodes.forEachVertex([&](uint32_t node, uint32_t vertex) {
      visit(QuadtreePlace{level, QuadtreePlace::kNodes, static_cast<NodeVertex>(vertex), node});
    });
    l.east.forEachVertex([&](uint32_t row, uint32_t) {
      visit(QuadtreePlace{level, QuadtreePlace::kEastBorder, kCentre, row});
    });
    l.south.forEachVertex([&](uint32_t column, uint32_t) {
      visit(QuadtreePlace{level, QuadtreePlace::kSouthBorder, kCentre, column});
    });
  }
}

}  // namespace tetrakis::inline quadtree
