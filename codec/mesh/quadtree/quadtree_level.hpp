// SPDX-License-Identifier: Apache-2.0
// QuadtreeLevel stores which vertices the nodes of one level of a semi-linear quadtree hold, and
// numbers them (thesis 4.3.2, 4.5).
//
// The nodes of a level below one node three levels up are 64 consecutive codes: a subtree level
// (property 4.1.3), here called a tile. A tile holds no code and no slot per node, but one bit per
// vertex in as many masks as a node has vertices, and the number of its first vertex. Present
// vertices are numbered without gaps, node after node along the z-curve, so their values stand in
// one array and those of a node side by side:
//
//   masks   bit n of masks[k]: vertex k of node 64 key + n is present
//   number  first + bits of all masks below n + bits of node n in masks before k
//
// The control algorithm, gather(), chooses the form of a level once its vertices are known:
//
//   sparse  tiles that hold something, in order of their keys: found by binary search
//   dense   the same tiles, and for every possible key the place of its tile: found at once
//   array   nothing is missing: neither tiles nor masks; number = first + vertices * node + k
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tetrakis::inline quadtree {

inline constexpr uint32_t kNoVertex = std::numeric_limits<uint32_t>::max();

/// Up to 64 nodes of one level with kVertices vertices each.
template <uint32_t kVertices>
struct QuadtreeTile {
  static_assert(kVertices >= 1 && kVertices <= 3, "sums of nibbles in rank()");
  static constexpr uint32_t kNodes = 64;

  std::array<uint64_t, kVertices> masks{};
  uint32_t first = 0;

  /// Bit n says whether node n is there. A node is there when its vertex 0 is.
  uint64_t nodes() const { return masks[0]; }
  bool has(uint32_t n, uint32_t vertex) const { return masks[vertex] >> n & 1; }

  /// Vertices of the nodes before n. One population count over all masks: pairs, then nibbles (at
  /// most 4 a mask), added up before they are folded to bytes and multiplied together.
  uint32_t rank(uint32_t n) const {
    const uint64_t below = (uint64_t{1} << n) - 1;
    uint64_t nibbles = 0;
    for (uint64_t mask : masks) {
      mask &= below;
      mask -= mask >> 1 & 0x5555555555555555u;
      nibbles += (mask & 0x3333333333333333u) + (mask >> 2 & 0x3333333333333333u);
    }
    const uint64_t bytes = (nibbles & 0x0f0f0f0f0f0f0f0fu) + (nibbles >> 4 & 0x0f0f0f0f0f0f0f0fu);
    return static_cast<uint32_t>(bytes * 0x0101010101010101u >> 56);
  }

  /// Number of vertex k of node n; kNoVertex if absent.
  uint32_t number(uint32_t n, uint32_t k) const {
    if (!has(n, k)) return kNoVertex;
    uint32_t number = first + rank(n);
    for (uint32_t before = 0; before < k; ++before) number += has(n, before);
    return number;
  }
  /// Number of each vertex of node n.
  std::array<uint32_t, kVertices> numbers(uint32_t n) const {
    std::array<uint32_t, kVertices> numbers;
    uint32_t next = first + rank(n);
    for (uint32_t k = 0; k < kVertices; ++k) numbers[k] = has(n, k) ? next++ : kNoVertex;
    return numbers;
  }
};

enum class LevelForm { kSparse, kDense, kArray };

template <uint32_t kVertices>
class QuadtreeLevel {
 public:
  using Tile = QuadtreeTile<kVertices>;

  QuadtreeLevel(uint32_t node_count, uint32_t first_vertex)
      : node_count_(node_count), first_(first_vertex), end_(first_vertex) {}

  LevelForm form() const { return form_; }
  uint32_t vertexCount() const { return end_ - first_; }

  /// Adds a vertex, in ascending order of (node, vertex); only before gather().
  void append(uint32_t node, uint32_t vertex) {
    assert(node < node_count_ && vertex < kVertices);
    const uint32_t key = node / Tile::kNodes;
    if (keys_.empty() || keys_.back() != key) {
      keys_.push_back(key);
      tiles_.push_back({{}, end_});
    }
    tiles_.back().masks[vertex] |= uint64_t{1} << node % Tile::kNodes;
    ++end_;
  }

  /// Chooses the form, once all vertices have been appended.
  void gather() {
    if (vertexCount() == uint64_t{kVertices} * node_count_) {
      form_ = LevelForm::kArray;
      keys_ = {}, tiles_ = {};
    } else if (tileCount() <= kDenseTiles * keys_.size()) {
      form_ = LevelForm::kDense;
      indexTiles();
    }
    keys_.shrink_to_fit(), tiles_.shrink_to_fit();
  }

  /// The tile that holds a node, perhaps empty. `hint`: a place to look first, renewed; start at 0.
  Tile tile(uint32_t key, size_t& hint) const {
    if (form_ == LevelForm::kArray) return arrayTile(key);
    if (form_ == LevelForm::kDense) return tiles_[places_[key]];
    if (hint + 1 < keys_.size() && keys_[hint + 1] == key) ++hint;
    if (hint >= keys_.size() || keys_[hint] != key) {
      hint = lowerBound(key);
      if (hint == keys_.size() || keys_[hint] != key) return {};
    }
    return tiles_[hint];
  }

  /// Number of a vertex where the form is kArray.
  uint32_t arrayNumber(uint32_t node, uint32_t vertex) const {
    return first_ + kVertices * node + vertex;
  }
  /// The number of a vertex of a node; kNoVertex if it is absent.
  uint32_t find(uint32_t node, uint32_t vertex) const {
    if (form_ == LevelForm::kArray) return arrayNumber(node, vertex);
    size_t hint = 0;
    return tile(node / Tile::kNodes, hint).number(node % Tile::kNodes, vertex);
  }

  /// visit(node, vertex) in ascending order, which is that of the numbers.
  template <class Visit>
  void forEachVertex(Visit&& visit) const {
    if (form_ == LevelForm::kSparse) {
      for (size_t i = 0; i < keys_.size(); ++i) visitTile(keys_[i], tiles_[i], visit);
      return;
    }
    size_t unused = 0;
    for (uint32_t key = 0; key < tileCount(); ++key) visitTile(key, tile(key, unused), visit);
  }

  /// The bytes of memory that the tiles take. The values belong to the owner of the level.
  size_t bytes() const {
    return (keys_.capacity() + places_.capacity()) * sizeof(uint32_t) +
           tiles_.capacity() * sizeof(Tile);
  }

 private:
  /// Dense where the index of places is no larger than the tiles that it saves searching.
  static constexpr uint32_t kDenseTiles = sizeof(Tile) / sizeof(uint32_t);

  size_t tileCount() const { return (size_t{node_count_} + Tile::kNodes - 1) / Tile::kNodes; }

  Tile arrayTile(uint32_t key) const {
    const uint32_t before = key * Tile::kNodes;
    const uint32_t nodes = std::min(node_count_ - before, Tile::kNodes);
    Tile tile;
    tile.masks.fill(~uint64_t{0} >> (Tile::kNodes - nodes));
    tile.first = first_ + kVertices * before;
    return tile;
  }

  size_t lowerBound(uint32_t key) const {
    return static_cast<size_t>(std::lower_bound(keys_.begin(), keys_.end(), key) - keys_.begin());
  }

  /// Keys without a tile share an empty one at the end.
  void indexTiles() {
    places_.assign(tileCount(), static_cast<uint32_t>(keys_.size()));
    for (uint32_t i = 0; i < keys_.size(); ++i) places_[keys_[i]] = i;
    tiles_.push_back({{}, end_});
    keys_ = {};
  }

  template <class Visit>
  static void visitTile(uint32_t key, const Tile& tile, Visit& visit) {
    uint64_t nodes = 0;
    for (const uint64_t mask : tile.masks) nodes |= mask;
    for (; nodes != 0; nodes &= nodes - 1) {
      const auto n = static_cast<uint32_t>(std::countr_zero(nodes));
      for (uint32_t k = 0; k < kVertices; ++k)
        if (tile.has(n, k)) visit(key * Tile::kNodes + n, k);
    }
  }

  LevelForm form_ = LevelForm::kSparse;
  uint32_t node_count_;
  uint32_t first_, end_;          ///< numbers of the level's vertices
  std::vector<uint32_t> keys_;    ///< sparse: of each tile
  std::vector<uint32_t> places_;  ///< dense: of each key, the tile
  std::vector<Tile> tiles_;
};

/// Reads a level along a path: the tile is looked up only where the path leaves it.
template <uint32_t kVertices>
class LevelCursor {
 public:
  using Tile = QuadtreeTile<kVertices>;

  explicit LevelCursor(const QuadtreeLevel<kVertices>& level) : level_(&level) {}

  const Tile& tileOf(uint32_t node) {
    const uint32_t key = node / Tile::kNodes;
    if (key != key_) {
      tile_ = level_->tile(key, hint_);
      key_ = key;
    }
    return tile_;
  }
  /// Number of a vertex; kNoVertex if absent.
  uint32_t number(uint32_t node, uint32_t vertex) {
    if (level_->form() == LevelForm::kArray) return level_->arrayNumber(node, vertex);
    return tileOf(node).number(node % Tile::kNodes, vertex);
  }
  std::array<uint32_t, kVertices> numbers(uint32_t node) {
    return tileOf(node).numbers(node % Tile::kNodes);
  }

 private:
  const QuadtreeLevel<kVertices>* level_;
  size_t hint_ = 0;
  uint32_t key_ = std::numeric_limits<uint32_t>::max();
  Tile tile_;
};

}  // namespace tetrakis::inline quadtree
