// SPDX-License-Identifier: Apache-2.0
// Neighbour finding by Samet, Gargantini and Schrack; see quadtree_classics.hpp.
#include "bench/meshes/quadtree_classics.hpp"

#include <algorithm>
#include <numeric>

namespace tetrakis::bench {
namespace {

/// The bit of a child's number (z-curve) that a direction changes: columns are bit 0, rows bit 1.
constexpr uint32_t axisOf(Direction direction) {
  return direction == Direction::kEast || direction == Direction::kWest ? 1 : 2;
}

/// Samet's ADJ: a child lies at this side of its parent, so that a step leaves the parent.
constexpr bool atSide(uint32_t child, Direction direction) {
  const bool far = (child & axisOf(direction)) != 0;
  return far == (direction == Direction::kEast || direction == Direction::kSouth);
}

}  // namespace

SametStore::SametStore(const QuadtreeNodes& data) : shape_(data.shape), pool_(poolOf(data)) {}

void SametStore::step(Position& at, Direction direction) const {
  uint32_t path = 0, climbed = 0;  // REFLECTed children, the last one lowest
  const auto leaves = [&](uint32_t child) {
    path |= (child ^ axisOf(direction)) << 2 * climbed++;
    return atSide(child, direction);
  };
  bool outside = true;
  while (outside && at.missing > 0) {
    --at.missing;
    outside = leaves(at.below & 3);
    at.below >>= 2;
  }
  while (outside && pool_[at.node].parent != kNoNode) {
    const PooledNode& node = pool_[at.node];
    at.node = node.parent;
    outside = leaves(node.child);
  }
  if (outside)  // roots are the first of the pool, patch by patch
    at.node = shape_.nodeOf(stepped(shape_, shape_.squareOf(0, at.node), direction));
  while (climbed > 0) {
    const uint32_t child = path >> 2 * --climbed & 3;
    const uint32_t below = at.missing > 0 ? kNoNode : pool_[at.node].children[child];
    if (below != kNoNode) {
      at.node = below;
    } else {
      at.below = at.below << 2 | child;
      ++at.missing;
    }
  }
}

float SametStore::walk(Handle start, Direction direction, uint32_t steps) const {
  Position at{start, 0, 0};
  float sum = 0;
  for (uint32_t i = 0; i < steps; ++i) {
    step(at, direction);
    if (at.missing == 0) sum += pool_[at.node].values[kCentre];
  }
  return sum;
}

SortedNodes::SortedNodes(const QuadtreeNodes& data) : shape_(data.shape) {
  const auto keyOf = [&](uint32_t i) {
    const Square square = data.nodes[i].square;
    return uint64_t{codeOf(square)} << 5 | square.level;
  };
  std::vector<uint32_t> order(data.nodes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return keyOf(a) < keyOf(b); });
  keys_.reserve(order.size());
  values_.reserve(order.size());
  present_.reserve(order.size());
  for (const uint32_t i : order) {
    keys_.push_back(keyOf(i));
    values_.push_back(data.nodes[i].values);
    present_.push_back(data.nodes[i].present);
  }
}

float SortedNodes::heightAt(uint32_t code, uint32_t level) const {
  const uint64_t key = uint64_t{code} << 5 | level;
  const auto at = std::lower_bound(keys_.begin(), keys_.end(), key);
  if (at == keys_.end() || *at != key) return 0;
  return values_[static_cast<size_t>(at - keys_.begin())][kCentre];
}

uint32_t SortedNodes::patchBeside(uint32_t code, Direction direction) const {
  const Square patch = shape_.squareOf(0, code >> 2 * digits());
  return shape_.nodeOf(stepped(shape_, patch, direction)) << 2 * digits();
}

GargantiniStore::Handle GargantiniStore::handleOf(size_t i) const {
  const Square square = (*nodes_)[i].square;
  return {square.level, list_.codeOf(square)};
}

float GargantiniStore::walk(Handle start, Direction direction, uint32_t steps) const {
  const uint32_t local = (1u << 2 * list_.digits()) - 1;
  uint32_t code = start.code;
  float sum = 0;
  for (uint32_t i = 0; i < steps; ++i) {
    bool outside = true;
    for (uint32_t digit = list_.digits() - start.level; outside && digit < list_.digits();
         ++digit) {
      outside = atSide(code >> 2 * digit & 3, direction);
      code ^= axisOf(direction) << 2 * digit;
    }
    if (outside) code = list_.patchBeside(code, direction) | (code & local);
    sum += list_.heightAt(code, start.level);
  }
  return sum;
}

SchrackStore::Handle SchrackStore::handleOf(size_t i) const {
  const Square square = (*nodes_)[i].square;
  return {square.level, list_.codeOf(square)};
}

float SchrackStore::walk(Handle start, Direction direction, uint32_t steps) const {
  const uint32_t local = (1u << 2 * list_.digits()) - 1;
  const uint32_t columns = 0x55555555u & local, rows = 0xaaaaaaaau & local;
  const uint32_t along = axisOf(direction) == 1 ? columns : rows;
  const bool forward = direction == Direction::kEast || direction == Direction::kSouth;
  // One node of the level, or less one: all digits from the node's own on.
  const uint32_t shift = 2 * (list_.digits() - start.level);
  const uint32_t delta = (forward ? axisOf(direction) : along) << shift & local;
  uint32_t code = start.code;
  float sum = 0;
  for (uint32_t i = 0; i < steps; ++i) {
    const uint32_t before = code & local;
    // Ones in the other coordinate hand carries on.
    const uint32_t after = (((before | rows) + (delta & columns)) & columns) |
                           (((before | columns) + (delta & rows)) & rows);
    const bool outside = ((forward ? after : before) & along) == 0;
    code = (outside ? list_.patchBeside(code, direction) : code & ~local) | after;
    sum += list_.heightAt(code, start.level);
  }
  return sum;
}

}  // namespace tetrakis::bench
