// SPDX-License-Identifier: Apache-2.0
// A FaceWalk goes over all sides of a surface of faces, which are the patches of a forest or
// triangles, so that few bits tell how they are glued. It keeps the open sides of the faces that it
// has seen in rings, each running round these faces, and says which open side is next: one whose
// end has the most faces around it, since that corner is about to close (after P. Alliez and M.
// Desbrun, "Valence-driven connectivity encoding for 3D meshes", 2001). Thus sides are mostly glued
// to their neighbours in a ring.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

namespace tetrakis::inline stream {

class FaceWalk {
 public:
  static constexpr uint32_t kMostAround = 11;

  /// Faces around a corner that are told apart: mostly 4 squares or 6 triangles lie around one.
  uint32_t mostAround() const { return of_face_ == 3 ? kMostAround : 7; }

  /// sides: of each face. Side s is one of face s / sides.
  FaceWalk(uint32_t faces, uint32_t sides) : of_face_(sides), sides_(size_t{faces} * sides) {}

  bool isOpen(uint32_t side) const { return sides_[side].open; }
  /// Of an open side: what follows in its ring, open or a border. It may be the side itself.
  uint32_t next(uint32_t side) const { return sides_[side].next; }
  uint32_t last(uint32_t side) const { return sides_[side].last; }
  /// Of the faces that the walk has seen, those that lie around the corner where an open side
  /// begins, or ends. Up to mostAround().
  uint32_t aroundStart(uint32_t side) const { return std::min(sides_[side].around, mostAround()); }
  uint32_t aroundEnd(uint32_t side) const { return aroundStart(next(side)); }

  /// The face of that side is seen: its sides are a ring of their own.
  void meet(uint32_t side) {
    for (uint32_t i = 0; i < of_face_; ++i)
      sides_[beside(side, i)] = {beside(side, i + 1), beside(side, i + of_face_ - 1), 1, true};
    for (uint32_t i = 0; i < of_face_; ++i) wait(beside(side, i));
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
    uint32_t around = 0;  ///< faces around the corner where it begins
    bool open = false;
  };

  /// So many sides on, round the same face.
  uint32_t beside(uint32_t side, uint32_t steps) const {
    const uint32_t within = side % of_face_;
    return side - within + (within + steps) % of_face_;
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

  uint32_t of_face_;
  std::vector<Side> sides_;
  std::array<std::vector<uint32_t>, kMostAround + 1> waiting_;  ///< by rank; some closed since
};

}  // namespace tetrakis::inline stream
