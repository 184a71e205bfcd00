// SPDX-License-Identifier: Apache-2.0
// A ForestWalk goes over all sides of a forest, so that few bits tell how they are glued. It keeps
// the open sides of the patches that it has seen in rings, each running clockwise round these
// patches, and says which open side is next: one whose end has the most patches around it, since
// that corner is about to close (after P. Alliez and M. Desbrun, "Valence-driven connectivity
// encoding for 3D meshes", 2001). Thus sides are mostly glued to their neighbours in a ring.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/forest.hpp"

namespace tetrakis::inline stream {

class ForestWalk {
 public:
  static constexpr uint32_t kMostAround = 7;  ///< patches around a corner that are told apart

  explicit ForestWalk(uint32_t patches) : sides_(size_t{patches} * Forest::kSides) {}

  bool isOpen(uint32_t side) const { return sides_[side].open; }
  /// Of an open side: what follows in its ring, open or a border. It may be the side itself.
  uint32_t next(uint32_t side) const { return sides_[side].next; }
  uint32_t last(uint32_t side) const { return sides_[side].last; }
  /// Of the patches that the walk has seen, those that lie around the corner where an open side
  /// begins, or ends. Up to kMostAround.
  uint32_t aroundStart(uint32_t side) const { return std::min(sides_[side].around, kMostAround); }
  uint32_t aroundEnd(uint32_t side) const { return aroundStart(next(side)); }

  /// A patch that is glued to none that the walk has seen. There is no open side.
  void begin(uint32_t patch) {
    for (uint32_t i = 0; i < Forest::kSides; ++i) {
      const uint32_t side = Forest::kSides * patch + i;
      sides_[side] = {beside(side, 1), beside(side, 3), 1, true};
    }
    for (uint32_t i = 0; i < Forest::kSides; ++i) wait(Forest::kSides * patch + i);
  }

  /// The open side that is next; nothing where there is none.
  std::optional<uint32_t> front() {
    for (size_t rank = waiting_.size(); rank-- > 0;) {
      for (std::vector<uint32_t>& ones = waiting_[rank]; !ones.empty(); ones.pop_back()) {
        if (isOpen(ones.back()) && rankOf(ones.back()) == rank) return ones.back();
      }
    }
    return {};
  }

  void makeBorder(uint32_t side) {
    sides_[side].open = false;
    wait(last(side));
  }

  /// A patch that the walk has not seen, one side of which is glued to an open side.
  void attach(uint32_t side, uint32_t glued) {
    const uint32_t a = beside(glued, 1), b = beside(glued, 2), c = beside(glued, 3);
    const uint32_t before = last(side), behind = next(side), around = sides_[side].around;
    sides_[side].open = false;
    sides_[a] = {b, 0, around + 1, true};
    sides_[b] = {c, a, 1, true};
    sides_[c] = {0, b, 1, true};
    const bool alone = behind == side;  // the ring of a single side
    join(alone ? c : before, a);
    join(c, alone ? a : behind);
    ++sides_[next(c)].around;
    for (const uint32_t one : {last(a), a, b, c}) wait(one);
  }

  /// Glues two open sides.
  void glue(uint32_t a, uint32_t b) {
    assert(a != b && isOpen(a) && isOpen(b));
    const Side one = sides_[a], other = sides_[b];
    sides_[a].open = sides_[b].open = false;
    sides_[other.next].around += one.around;
    sides_[one.next].around += other.around;
    join(one.last, other.next);
    join(other.last, one.next);
    for (const uint32_t side : {one.last, other.last}) wait(side);
  }

 private:
  struct Side {
    uint32_t next = 0, last = 0;
    uint32_t around = 0;  ///< patches around the corner where it begins
    bool open = false;
  };

  /// So many sides on, clockwise round the same patch.
  static uint32_t beside(uint32_t side, uint32_t steps) {
    return side - side % Forest::kSides + (side + steps) % Forest::kSides;
  }
  void join(uint32_t a, uint32_t b) {
    sides_[a].next = b;
    sides_[b].last = a;
  }
  uint32_t rankOf(uint32_t side) const { return isOpen(next(side)) ? aroundEnd(side) : 0; }
  void wait(uint32_t side) {
    if (isOpen(side)) waiting_[rankOf(side)].push_back(side);
  }

  std::vector<Side> sides_;
  std::array<std::vector<uint32_t>, kMostAround + 1> waiting_;  ///< by rank; some closed since
};

}  // namespace tetrakis::inline stream
