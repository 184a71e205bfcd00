// SPDX-License-Identifier: Apache-2.0
// The neighbour finding that table 4.1 of the thesis compares with, as stores of bench_quadtree
// (quadtree_peers.hpp says what these must have). All find nodes of equal size, and step through
// squares that hold none.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bench/meshes/quadtree_peers.hpp"

namespace tetrakis::bench {

/// H. Samet, Neighbor finding techniques for images represented by quadtrees (1982): a tree of
/// pointers without coordinates. From a node up to the nearest common ancestor, which is the first
/// that is not left on the side of the neighbour, and down again by the mirrored way.
class SametStore {
 public:
  using Handle = uint32_t;  ///< place in the pool
  static constexpr const char* kName = "samet";

  explicit SametStore(const QuadtreeNodes& data);
  Handle handleOf(size_t i) const { return static_cast<uint32_t>(i); }
  float walk(Handle start, Direction direction, uint32_t steps) const;

 private:
  /// A square: its deepest ancestor in the tree, and the children to take from there, the last one
  /// in the lowest two bits.
  struct Position {
    uint32_t node = 0, missing = 0, below = 0;
  };
  void step(Position& at, Direction direction) const;

  QuadtreeShape shape_;
  std::vector<PooledNode> pool_;
};

/// All nodes in one list, sorted by location code, then by level (thesis 4.2.4). Codes have the
/// digits of the deepest level; those below a node's own are 0.
class SortedNodes {
 public:
  explicit SortedNodes(const QuadtreeNodes& data);

  const QuadtreeShape& shape() const { return shape_; }
  /// Digits of codes, base 4.
  uint32_t digits() const { return shape_.depth - 1; }
  /// The code after that of the patch, which has two bits a digit.
  uint32_t codeOf(Square s) const { return shape_.nodeOf(s) << 2 * (digits() - s.level); }
  /// The height of the centre of a node, by binary search; 0 where none is.
  float heightAt(uint32_t code, uint32_t level) const;
  /// The patch beside that of a code, in the place of its own.
  uint32_t patchBeside(uint32_t code, Direction direction) const;

 private:
  QuadtreeShape shape_;
  std::vector<uint64_t> keys_;  ///< code, level in the lowest five bits
  std::vector<std::array<float, 3>> values_;
  std::vector<uint8_t> present_;
};

/// I. Gargantini, An effective way to represent quadtrees (1982): digits of the code are reflected,
/// from the last one on, up to the first that does not leave its parent.
class GargantiniStore {
 public:
  struct Handle {
    uint32_t level = 0, code = 0;
  };
  static constexpr const char* kName = "gargantini";

  explicit GargantiniStore(const QuadtreeNodes& data) : list_(data), nodes_(&data.nodes) {}
  Handle handleOf(size_t i) const;
  float walk(Handle start, Direction direction, uint32_t steps) const;

 private:
  SortedNodes list_;
  const std::vector<QuadtreeNode>* nodes_;
};

/// G. Schrack, Finding neighbors of equal size in linear quadtrees and octrees in constant time
/// (1992): the same list; both coordinates of the code are added to at once, as dilated integers.
class SchrackStore {
 public:
  struct Handle {
    uint32_t level = 0, code = 0;
  };
  static constexpr const char* kName = "schrack";

  explicit SchrackStore(const QuadtreeNodes& data) : list_(data), nodes_(&data.nodes) {}
  Handle handleOf(size_t i) const;
  float walk(Handle start, Direction direction, uint32_t steps) const;

 private:
  SortedNodes list_;
  const std::vector<QuadtreeNode>* nodes_;
};

}  // namespace tetrakis::bench
