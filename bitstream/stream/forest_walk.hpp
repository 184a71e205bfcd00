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

  /// The patch of that side is seen: its sides are a ring of their own.
  void meet(uint32_t side) {
    for (uint32_t i = 0; i < Forest::kSides; ++i)
      sides_[beside(side, i)] = {beside(side, i + 1), beside(side, i + 3), 1, true};
    for (uint32_t i = 0; i < Forest::kSides; ++i) wait(beside(side, i));
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

  /// Glues two open sides.
  void glue(uint32_t a, uint32_t b) {
    assert(a != b && isOpen(a) && isOpen(b));
    sides_[a].open = sides_[b].open = false;
    joinBehind(a, b);
    joinBehind(b, a);
    for (const uint32_t side : {last(a), last(b)}) wait(side);
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
  /// What comes before `a` in its ring is followed by what comes behind `b`. Done both ways round
  /// this takes the two sides out of their rings, also where one of them is all of its ring.
  void joinBehind(uint32_t a, uint32_t b) {
    const uint32_t before = last(a), behind = next(b);
    sides_[behind].around += sides_[a].around;
    sides_[before].next = behind;
    sides_[behind].last = before;
  }
  uint32_t rankOf(uint32_t side) const { return isOpen(next(side)) ? aroundEnd(side) : 0; }
  void wait(uint32_t side) {
    if (isOpen(side)) waiting_[rankOf(side)].push_back(side);
  }

  std::vector<Side> sides_;
  std::array<std::vector<uint32_t>, kMostAround + 1> waiting_;  ///< by rank; some closed since
};

}  // namespace tetrakis::inline stream
