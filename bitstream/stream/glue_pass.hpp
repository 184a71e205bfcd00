// SPDX-License-Identifier: Apache-2.0
// GluePass codes which sides of faces are glued to which, in the order of a FaceWalk. Of each open
// side it says: glued to the one behind it in its ring, or to the one before; to a face that the
// walk has not seen; a border; or else glued to another open side, by its number. Faces that are
// numbered as the walk meets them, and turned so that it enters by their first sides, take some 1.5
// bits each.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "base/forest.hpp"
#include "bitstream/coder/adaptive_bit.hpp"
#include "bitstream/stream/face_walk.hpp"

namespace tetrakis::inline stream {

/// Io: as of coder/value_table_pass.hpp.
template <class Io>
class GluePass {
 public:
  /// sides: of each face, 3 or 4.
  GluePass(Io& io, uint32_t faces, uint32_t sides)
      : io_(io), faces_(faces), of_face_(sides), walk_(faces, sides), seen_(faces) {}

  /// sides: of the encoder as of Forest, of the decoder as many borders, which it fills.
  /// Returns whether they are sound: false where a decision that counts names a side or a face
  /// that cannot be glued, and where the codeword ends too early.
  bool run(std::vector<uint32_t>& sides) {
    while (sound_ && !io_.stopped()) {
      if (const auto side = walk_.front()) {
        takeSide(*side, sides);
      } else if (lowestUnseen() < faces_) {
        seen_[lowest_] = 1;
        walk_.meet(of_face_ * lowest_);
      } else {
        return true;
      }
    }
    return false;
  }

 private:
  void takeSide(uint32_t side, std::vector<uint32_t>& sides) {
    const uint32_t next = walk_.next(side), last = walk_.last(side), other = sides[side];
    const bool may_next = next != side && walk_.isOpen(next);
    const bool may_last = last != side && last != next && walk_.isOpen(last);
    const uint32_t end = walk_.aroundEnd(side), start = walk_.aroundStart(side);
    if (may_next && io_.decide(next_[end][may_last], other == next)) return glue(side, next, sides);
    if (may_last && io_.decide(last_[start][may_next], other == last))
      return glue(side, last, sides);
    const bool is_border = other == Forest::kBorder;
    if (lowestUnseen() < faces_ &&
        io_.decide(new_[may_next][may_last], !is_border && isUnseen(other)))
      return attach(side, sides);
    if (io_.decide(border_[may_next][may_last], is_border)) {
      if (io_.stopped()) return;
      sides[side] = Forest::kBorder;
      return walk_.makeBorder(side);
    }
    const uint32_t named = plain(other, of_face_ * faces_);
    sound_ = named < sides.size() && named != side && walk_.isOpen(named);
    if (sound_) glue(side, named, sides);
  }

  bool isUnseen(uint32_t side) const { return seen_[side / of_face_] == 0; }

  void glue(uint32_t a, uint32_t b, std::vector<uint32_t>& sides) {
    if (io_.stopped()) return;
    sides[a] = b;
    sides[b] = a;
    walk_.glue(a, b);
  }

  /// A face is mostly the one of the lowest number, entered by the same side as others.
  void attach(uint32_t side, std::vector<uint32_t>& sides) {
    const uint32_t lowest = lowestUnseen(), other = sides[side], turn = other % of_face_;
    const uint32_t face = io_.decide(numbers_in_order_, other / of_face_ != lowest)
                              ? plain(other / of_face_, faces_)
                              : lowest;
    const bool high = io_.decide(turn_[0], (turn & 2) != 0);
    const bool low = io_.decide(turn_[high ? 2 : 1], (turn & 1) != 0);
    if (io_.stopped()) return;
    const uint32_t entered = 2 * uint32_t{high} + uint32_t{low};
    sound_ = face < faces_ && seen_[face] == 0 && entered < of_face_;
    if (!sound_) return;
    seen_[face] = 1;
    walk_.meet(of_face_ * face + entered);
    glue(side, of_face_ * face + entered, sides);
  }

  uint32_t lowestUnseen() {
    while (lowest_ < faces_ && seen_[lowest_] != 0) ++lowest_;
    return lowest_;
  }

  /// A number below `count`, or what the next power of two lets through.
  uint32_t plain(uint32_t number, uint32_t count) {
    uint32_t value = 0;
    for (int bit = static_cast<int>(std::bit_width(count - 1)) - 1; bit >= 0; --bit)
      value = value << 1 | uint32_t{io_.even((number >> bit) & 1)};
    return value;
  }

  using Around = std::array<std::array<AdaptiveBit, 2>, FaceWalk::kMostAround + 1>;

  Io& io_;
  uint32_t faces_, of_face_;
  FaceWalk walk_;
  std::vector<uint8_t> seen_;  ///< faces
  uint32_t lowest_ = 0;        ///< no face below it is unseen
  bool sound_ = true;
  Around next_, last_;
  std::array<std::array<AdaptiveBit, 2>, 2> new_, border_;
  AdaptiveBit numbers_in_order_;
  std::array<AdaptiveBit, 3> turn_;
};

}  // namespace tetrakis::inline stream
