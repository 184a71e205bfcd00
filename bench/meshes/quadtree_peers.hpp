// SPDX-License-Identifier: Apache-2.0
// Ways to store the nodes of a forest of quadtrees, behind one interface for bench_quadtree:
//
//   Store(const QuadtreeNodes&)      builds it
//   Handle handleOf(size_t i)        what the store wants to know of node i to start from it
//   float walk(Handle, Direction, steps)   sum of the centre heights of the next `steps` nodes in
//                                    one direction that are present; toroidal
//
// All heights of a walk are read where they are stored. Each store is as fast and small as its idea
// allows: levels apart, 32-bit indices, pools, constant-time codes of neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "codec/mesh/quadtree/location_code.hpp"
#include "codec/mesh/quadtree/semilinear_quadtree.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::bench {

enum class Direction : uint8_t { kEast, kSouth, kWest, kNorth };

/// A node with its three vertices; bit k of `present`: vertex k is there.
struct QuadtreeNode {
  Square square;
  std::array<float, 3> values{};
  uint8_t present = 0;
};

struct QuadtreeNodes {
  QuadtreeShape shape;
  std::vector<QuadtreeNode> nodes;                 ///< level after level along the z-curve
  std::vector<SemilinearQuadtree::Entry> entries;  ///< the same, and the borders' vertices
};

/// No child, or no parent.
inline constexpr uint32_t kNoNode = std::numeric_limits<uint32_t>::max();

/// A node of a tree of pointers.
struct PooledNode {
  std::array<uint32_t, 4> children{kNoNode, kNoNode, kNoNode, kNoNode};
  uint32_t parent = kNoNode;
  std::array<float, 3> values{};
  uint8_t present = 0, child = 0;  ///< child: which of its parent
};

/// In the order of `data`: roots first, patch by patch.
std::vector<PooledNode> poolOf(const QuadtreeNodes& data);

/// One step, toroidal.
inline Square stepped(const QuadtreeShape& shape, Square s, Direction direction) {
  const uint32_t columns = shape.columnsOf(s.level), rows = shape.rowsOf(s.level);
  switch (direction) {
    case Direction::kEast:
      s.column = s.column + 1 == columns ? 0 : s.column + 1;
      break;
    case Direction::kSouth:
      s.row = s.row + 1 == rows ? 0 : s.row + 1;
      break;
    case Direction::kWest:
      s.column = (s.column == 0 ? columns : s.column) - 1;
      break;
    case Direction::kNorth:
      s.row = (s.row == 0 ? rows : s.row) - 1;
      break;
  }
  return s;
}

/// The semi-linear quadtree of codec/mesh/quadtree: one addition a step, one look-up a tile.
class SemilinearStore {
 public:
  using Handle = Square;
  static constexpr const char* kName = "semilinear";

  explicit SemilinearStore(const QuadtreeNodes& data);
  Handle handleOf(size_t i) const { return (*nodes_)[i].square; }
  float walk(Square start, Direction direction, uint32_t steps) const;

 private:
  template <class Step>
  float walkBy(Square start, uint32_t steps, Step step) const;

  const std::vector<QuadtreeNode>* nodes_;
  IndexDifferences differences_;
  SemilinearQuadtree tree_;
};

/// Nodes in a pool, with the indices of four children and the parent. Coordinates tell how high a
/// step has to climb and where it descends; where nothing is, it stays at the deepest ancestor.
class PointerStore {
 public:
  struct Handle {
    uint32_t node = 0;
    Square square;
  };
  static constexpr const char* kName = "pointers";

  explicit PointerStore(const QuadtreeNodes& data);
  Handle handleOf(size_t i) const { return {static_cast<uint32_t>(i), (*nodes_)[i].square}; }
  float walk(Handle start, Direction direction, uint32_t steps) const;

 private:
  const std::vector<QuadtreeNode>* nodes_;
  QuadtreeShape shape_;
  std::vector<PooledNode> pool_;
};

/// Location codes sorted level by level, values beside them: what SchrackStore is, but with shorter
/// codes and searches, and one coordinate to a step.
class LinearStore {
 public:
  struct Handle {
    uint32_t level = 0, code = 0;
  };
  static constexpr const char* kName = "linear";

  explicit LinearStore(const QuadtreeNodes& data);
  Handle handleOf(size_t i) const;
  float walk(Handle start, Direction direction, uint32_t steps) const;

 private:
  struct Level {
    std::vector<uint32_t> codes;
    std::vector<std::array<float, 3>> values;
    std::vector<uint8_t> present;
  };

  QuadtreeShape shape_;
  std::vector<Level> levels_;
  const std::vector<QuadtreeNode>* nodes_;
};

/// std::unordered_map from location code to values; codes of neighbours as above.
class HashStore {
 public:
  struct Handle {
    uint32_t level = 0, code = 0;
  };
  static constexpr const char* kName = "hash";

  explicit HashStore(const QuadtreeNodes& data);
  Handle handleOf(size_t i) const;
  float walk(Handle start, Direction direction, uint32_t steps) const;

 private:
  struct Values {
    std::array<float, 3> values{};
    uint8_t present = 0;
  };

  QuadtreeShape shape_;
  std::unordered_map<uint32_t, Values> map_;
  const std::vector<QuadtreeNode>* nodes_;
};

/// What meshes are made of without a quadtree: for every vertex of the lattice, present or not, its
/// index among the values. Small and fast only where most vertices are present.
class GridStore {
 public:
  using Handle = Square;
  static constexpr const char* kName = "grid";

  explicit GridStore(const QuadtreeNodes& data);
  Handle handleOf(size_t i) const { return (*nodes_)[i].square; }
  float walk(Square start, Direction direction, uint32_t steps) const;

 private:
  /// Three indices a node, row by row.
  size_t slotOf(Square s) const {
    return first_[s.level] + 3 * (size_t{s.row} * shape_.columnsOf(s.level) + s.column);
  }

  const std::vector<QuadtreeNode>* nodes_;
  QuadtreeShape shape_;
  std::vector<size_t> first_;
  std::vector<uint32_t> index_;
  std::vector<float> values_;
};

}  // namespace tetrakis::bench
