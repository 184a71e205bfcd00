// SPDX-License-Identifier: Apache-2.0
// Stores of quadtree nodes; see quadtree_peers.hpp.
#include "bench/meshes/quadtree_peers.hpp"

#include <algorithm>
#include <bit>

namespace tetrakis::bench {
namespace {

/// Schrack's constant-time neighbours: the bits of the other coordinate are filled with ones, so
/// that a carry runs through them, or masked out, so that a borrow does. Patches in a row or column
/// are further digits of the coordinate along it. code: within the level.
uint32_t neighbourCode(const QuadtreeShape& shape, uint32_t level, uint32_t code,
                       Direction direction) {
  const uint32_t size = 1u << 2 * level;
  const uint32_t patch = code >> 2 * level, local = code & (size - 1);
  const uint32_t columns = 0x55555555u & (size - 1), rows = 0xaaaaaaaau & (size - 1);
  const auto patchAt = [&](Direction d) {
    return shape.nodeOf(stepped(shape, shape.squareOf(0, patch), d));
  };
  const auto moved = [&](uint32_t axis, uint32_t other, bool forward) {
    const uint32_t along =
        forward ? (local | other) + (axis & (0u - axis)) : (local & axis) - (axis & (0u - axis));
    const bool leaves = forward ? (local & axis) == axis : (local & axis) == 0;
    const uint32_t target = leaves ? patchAt(direction) : patch;
    return (target << 2 * level) | (along & axis) | (local & other);
  };
  switch (direction) {
    case Direction::kEast:
      return moved(columns, rows, true);
    case Direction::kWest:
      return moved(columns, rows, false);
    case Direction::kSouth:
      return moved(rows, columns, true);
    case Direction::kNorth:
      return moved(rows, columns, false);
  }
  return code;
}

}  // namespace

SemilinearStore::SemilinearStore(const QuadtreeNodes& data)
    : nodes_(&data.nodes),
      differences_(data.shape),
      tree_(data.shape, std::vector<float>((data.shape.columns + 1) * (data.shape.rows + 1))) {
  tree_.update(data.entries, {});
}

template <class Step>
float SemilinearStore::walkBy(Square start, uint32_t steps, Step step) const {
  Traversal path(differences_, start);
  LevelCursor<3> cursor(tree_.nodes(start.level));
  float sum = 0;
  for (uint32_t i = 0; i < steps; ++i) {
    step(path);
    const uint32_t number = cursor.number(path.node(), kCentre);
    if (number != kNoVertex) sum += tree_.values()[number];
  }
  return sum;
}

float SemilinearStore::walk(Square start, Direction direction, uint32_t steps) const {
  switch (direction) {
    case Direction::kEast:
      return walkBy(start, steps, [](Traversal& t) { t.east(); });
    case Direction::kSouth:
      return walkBy(start, steps, [](Traversal& t) { t.south(); });
    case Direction::kWest:
      return walkBy(start, steps, [](Traversal& t) { t.west(); });
    case Direction::kNorth:
      return walkBy(start, steps, [](Traversal& t) { t.north(); });
  }
  return 0;
}

std::vector<PooledNode> poolOf(const QuadtreeNodes& data) {
  std::vector<PooledNode> pool;
  pool.reserve(data.nodes.size());
  std::vector<uint32_t> above, current;  // nodes of two levels by their number
  uint32_t level = kNoNode;
  for (const QuadtreeNode& node : data.nodes) {
    const auto id = static_cast<uint32_t>(pool.size());
    if (node.square.level != level) {
      level = node.square.level;
      above.swap(current);
      current.assign(data.shape.nodesOf(level), kNoNode);
    }
    const uint32_t number = data.shape.nodeOf(node.square);
    current[number] = id;
    PooledNode& stored = pool.emplace_back();
    stored.values = node.values;
    stored.present = node.present;
    stored.child = number % 4;
    if (level == 0) continue;
    stored.parent = above[number / 4];
    pool[stored.parent].children[number % 4] = id;
  }
  return pool;
}

PointerStore::PointerStore(const QuadtreeNodes& data)
    : nodes_(&data.nodes), shape_(data.shape), pool_(poolOf(data)) {}

float PointerStore::walk(Handle start, Direction direction, uint32_t steps) const {
  const uint32_t target = start.square.level;
  uint32_t node = start.node, level = target;  // the deepest ancestor of the square
  Square square = start.square;
  float sum = 0;
  for (uint32_t i = 0; i < steps; ++i) {
    const Square next = stepped(shape_, square, direction);
    const uint32_t up = static_cast<uint32_t>(
        std::bit_width((next.column ^ square.column) | (next.row ^ square.row)));
    square = next;
    if (up > target) {  // another patch: roots are the first of the pool
      level = 0;
      node = shape_.nodeOf({0, square.column >> target, square.row >> target});
    }
    for (; level + up > target && level > 0; --level) node = pool_[node].parent;
    for (; level < target; ++level) {
      const uint32_t shift = target - level - 1;
      const uint32_t child = (square.column >> shift & 1) + 2 * (square.row >> shift & 1);
      const uint32_t below = pool_[node].children[child];
      if (below == kNoNode) break;
      node = below;
    }
    if (level == target) sum += pool_[node].values[kCentre];
  }
  return sum;
}

LinearStore::LinearStore(const QuadtreeNodes& data)
    : shape_(data.shape), levels_(data.shape.depth), nodes_(&data.nodes) {
  std::vector<size_t> counts(shape_.depth);
  for (const QuadtreeNode& node : data.nodes) ++counts[node.square.level];
  for (uint32_t level = 0; level < shape_.depth; ++level) {
    levels_[level].codes.reserve(counts[level]);
    levels_[level].values.reserve(counts[level]);
    levels_[level].present.reserve(counts[level]);
  }
  for (const QuadtreeNode& node : data.nodes) {
    Level& level = levels_[node.square.level];
    level.codes.push_back(shape_.nodeOf(node.square));
    level.values.push_back(node.values);
    level.present.push_back(node.present);
  }
}

LinearStore::Handle LinearStore::handleOf(size_t i) const {
  const Square square = (*nodes_)[i].square;
  return {square.level, shape_.nodeOf(square)};
}

float LinearStore::walk(Handle start, Direction direction, uint32_t steps) const {
  const Level& level = levels_[start.level];
  uint32_t code = start.code;
  float sum = 0;
  for (uint32_t i = 0; i < steps; ++i) {
    code = neighbourCode(shape_, start.level, code, direction);
    const auto at = std::lower_bound(level.codes.begin(), level.codes.end(), code);
    if (at != level.codes.end() && *at == code)
      sum += level.values[static_cast<size_t>(at - level.codes.begin())][kCentre];
  }
  return sum;
}

HashStore::HashStore(const QuadtreeNodes& data) : shape_(data.shape), nodes_(&data.nodes) {
  map_.reserve(data.nodes.size());
  for (const QuadtreeNode& node : data.nodes)
    map_[shape_.codeOf(node.square)] = {node.values, node.present};
}

HashStore::Handle HashStore::handleOf(size_t i) const {
  const Square square = (*nodes_)[i].square;
  return {square.level, shape_.nodeOf(square)};
}

float HashStore::walk(Handle start, Direction direction, uint32_t steps) const {
  const uint32_t first = shape_.firstOf(start.level);
  uint32_t code = start.code;
  float sum = 0;
  for (uint32_t i = 0; i < steps; ++i) {
    code = neighbourCode(shape_, start.level, code, direction);
    const auto at = map_.find(first + code);
    if (at != map_.end()) sum += at->second.values[kCentre];
  }
  return sum;
}

GridStore::GridStore(const QuadtreeNodes& data) : nodes_(&data.nodes), shape_(data.shape) {
  size_t slots = 0, values = 0;
  for (uint32_t level = 0; level < shape_.depth; ++level) {
    first_.push_back(slots);
    slots += size_t{3} * shape_.nodesOf(level);
  }
  for (const QuadtreeNode& node : data.nodes)
    values += static_cast<size_t>(std::popcount(node.present));
  index_.assign(slots, kNoNode);
  values_.reserve(values);
  for (const QuadtreeNode& node : data.nodes)
    for (uint32_t k = 0; k < 3; ++k) {
      if ((node.present >> k & 1) == 0) continue;
      index_[slotOf(node.square) + k] = static_cast<uint32_t>(values_.size());
      values_.push_back(node.values[k]);
    }
}

float GridStore::walk(Square square, Direction direction, uint32_t steps) const {
  float sum = 0;
  for (uint32_t i = 0; i < steps; ++i) {
    square = stepped(shape_, square, direction);
    const uint32_t index = index_[slotOf(square) + kCentre];
    if (index != kNoNode) sum += values_[index];
  }
  return sum;
}

}  // namespace tetrakis::bench
