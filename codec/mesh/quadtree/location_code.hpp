// SPDX-License-Identifier: Apache-2.0
// Location codes number the nodes of a forest of quadtrees (QuadtreeShape). IndexDifferences and
// Traversal go from a node to its neighbours by adding to its code, so that no code is taken apart
// on the way (thesis 4.3 to 4.6).
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstdint>

namespace tetrakis::inline quadtree {

// Location codes number the nodes of a forest of quadtrees (thesis 4.3.1, definition 4.1, property
// 4.1; 4.6).
//
// A patch is one quadtree of `depth` levels; level i cuts its square into 2^i x 2^i nodes, which
// are numbered along the z-curve (child 0 north-west, 1 north-east, 2 south-west, 3 south-east):
//
//   digit of the code, base 4      coordinates (4.12): bit 0 of a digit is a bit of the column,
//        0 | 1                     bit 1 a bit of the row
//        --+--
//        2 | 3
//
// The code of a node counts all nodes of the levels above, then those before it in its level. A
// forest of P patches, row by row, is one code space too: level after level, patch after patch
// within a level. Every formula of the thesis holds with its 1 replaced by P: level i begins at
// P (4^i - 1) / 3 and the children of p are 4p + P ... 4p + P + 3.

/// A node by its place: `column`, `row` count the nodes of `level` over the whole forest from the
/// north-west.
struct Square {
  uint32_t level = 0, column = 0, row = 0;
  bool operator==(const Square&) const = default;
};

/// Bits of v to the even places: the interleaved coordinates of thesis 4.3.1. v < 2^16.
constexpr uint32_t dilate(uint32_t v) {
  v = (v | v << 8) & 0x00ff00ffu;
  v = (v | v << 4) & 0x0f0f0f0fu;
  v = (v | v << 2) & 0x33333333u;
  return (v | v << 1) & 0x55555555u;
}

/// The inverse of spreading bits to the even places; bits at odd places are ignored.
constexpr uint32_t undilate(uint32_t v) {
  v &= 0x55555555u;
  v = (v | v >> 1) & 0x33333333u;
  v = (v | v >> 2) & 0x0f0f0f0fu;
  v = (v | v >> 4) & 0x00ff00ffu;
  return (v | v >> 8) & 0x0000ffffu;
}

/// columns x rows patches of `depth` levels each; codes stay below 2^32 (depth <= 16).
struct QuadtreeShape {
  uint32_t depth = 0, columns = 1, rows = 1;

  constexpr uint32_t patches() const { return columns * rows; }
  constexpr uint32_t columnsOf(uint32_t level) const { return columns << level; }
  constexpr uint32_t rowsOf(uint32_t level) const { return rows << level; }
  constexpr uint32_t nodesOf(uint32_t level) const { return patches() << 2 * level; }

  /// Code of the first node of a level; of all codes together for level = depth.
  constexpr uint32_t firstOf(uint32_t level) const {
    return static_cast<uint32_t>(patches() * (((uint64_t{1} << 2 * level) - 1) / 3));
  }
  /// floor(log4(3p + 1)), property 4.1.1.
  constexpr uint32_t levelOf(uint32_t code) const {
    return static_cast<uint32_t>(std::bit_width(uint64_t{3} * (code / patches()) + 1) - 1) / 2;
  }
  constexpr uint32_t codeOf(Square s) const { return firstOf(s.level) + nodeOf(s); }
  constexpr Square squareOf(uint32_t code) const {
    const uint32_t level = levelOf(code);
    return squareOf(level, code - firstOf(level));
  }

  /// Number of a node within its level: the local location code (4.11), after those of the patches
  /// before. Children of n are 4n ... 4n + 3, and differences between neighbours those of codes.
  constexpr uint32_t nodeOf(Square s) const {
    assert(s.column < columnsOf(s.level) && s.row < rowsOf(s.level));
    const uint32_t mask = (1u << s.level) - 1;
    const uint32_t patch = (s.row >> s.level) * columns + (s.column >> s.level);
    return (patch << 2 * s.level) + dilate(s.column & mask) + 2 * dilate(s.row & mask);
  }
  constexpr Square squareOf(uint32_t level, uint32_t node) const {
    const uint32_t patch = node >> 2 * level;
    const uint32_t local = node & ((1u << 2 * level) - 1);
    return {level, undilate(local) + (patch % columns << level),
            undilate(local >> 1) + (patch / columns << level)};
  }
};

// IndexDifferences gives the difference between the location codes of two neighbours in closed
// form, so that a traversal goes on by one addition (thesis 4.4, theorem 4.1).
//
// Neighbours whose lowest common ancestor is r + 1 levels up differ by a constant. Between columns
// g - 1 and g of a level that r, the relative level distance (4.6), is the number of zeros that g
// ends with; so one short table replaces the delta-vectors of 2^i + 1 entries (4.7). Where g is a
// multiple of 2^i the step leaves the patch: it is the toroidal difference (4.2), (4.4), plus the
// distance to the patch that it enters, times 4^i.

constexpr int64_t powerOfFour(uint32_t exponent) {
  return int64_t{1} << 2 * exponent;
}
/// (4.1): between horizontal neighbours at relative level distance r. Vertical differences are
/// twice as large: (4.3), (4.4).
constexpr int64_t horizontalDifference(uint32_t r) {
  return (2 * powerOfFour(r) + 1) / 3;
}
/// (4.2): between the ends of a row of the 2^level nodes that a patch has there.
constexpr int64_t toroidalHorizontalDifference(uint32_t level) {
  return (powerOfFour(level) - 1) / 3;
}

/// All differences of a forest. Additions are modulo 2^32, so that steps back need no sign.
class IndexDifferences {
 public:
  explicit IndexDifferences(QuadtreeShape shape) : shape_(shape) {
    for (uint32_t level = 0; level < kLevels; ++level) {
      const int64_t patch = powerOfFour(level), torus = toroidalHorizontalDifference(level);
      within_[level] = static_cast<uint32_t>(horizontalDifference(level));
      Border& border = borders_[level];
      border.enter_east = static_cast<uint32_t>(patch - torus);
      border.wrap_east = static_cast<uint32_t>(-torus - (shape.columns - 1) * patch);
      border.enter_south = static_cast<uint32_t>(shape.columns * patch - 2 * torus);
      border.wrap_south =
          static_cast<uint32_t>(-2 * torus - int64_t{shape.rows - 1} * shape.columns * patch);
    }
  }

  const QuadtreeShape& shape() const { return shape_; }

  /// What a step east from column g - 1 to column g adds. g = 0 and g = columns of the level: from
  /// the last column to the first.
  uint32_t horizontal(uint32_t level, uint32_t g) const {
    const auto r = static_cast<uint32_t>(std::countr_zero(g | 1u << level));
    if (r < level) return within_[r];
    const bool wraps = g == 0 || g == shape_.columnsOf(level);
    return wraps ? borders_[level].wrap_east : borders_[level].enter_east;
  }
  /// The difference of a step south, from row g - 1 to row g.
  uint32_t vertical(uint32_t level, uint32_t g) const {
    const auto r = static_cast<uint32_t>(std::countr_zero(g | 1u << level));
    if (r < level) return 2 * within_[r];
    const bool wraps = g == 0 || g == shape_.rowsOf(level);
    return wraps ? borders_[level].wrap_south : borders_[level].enter_south;
  }

 private:
  static constexpr uint32_t kLevels = 16;
  struct Border {
    uint32_t enter_east = 0, wrap_east = 0, enter_south = 0, wrap_south = 0;
  };

  QuadtreeShape shape_;
  std::array<uint32_t, kLevels> within_{};
  std::array<Border, kLevels> borders_{};
};

// Traversal moves from node to node of a forest by one addition a step, so that no location code is
// decoded on the way (thesis 4.4.4).
//
// A traversal is a scaling to another level (4.23) followed by unit steps; a traversal path visits
// the nodes on the way. The coordinates of the first node are decoded once, then kept. Steps are
// toroidal over the whole forest: east of the last column is the first.

/// A node that moves through a forest by steps. `differences` must outlive it.
class Traversal {
 public:
  Traversal(const IndexDifferences& differences, Square start)
      : differences_(&differences), square_(start), node_(differences.shape().nodeOf(start)) {}

  const Square& square() const { return square_; }
  uint32_t code() const { return shape().firstOf(square_.level) + node_; }
  /// Number within the level (QuadtreeShape::nodeOf): what the steps below add to.
  uint32_t node() const { return node_; }

  bool atEastBorder() const { return square_.column + 1 == shape().columnsOf(square_.level); }
  bool atSouthBorder() const { return square_.row + 1 == shape().rowsOf(square_.level); }

  Traversal& east() {  // (4.16)
    node_ += differences_->horizontal(square_.level, square_.column + 1);
    square_.column = atEastBorder() ? 0 : square_.column + 1;
    return *this;
  }
  Traversal& west() {  // (4.15)
    node_ -= differences_->horizontal(square_.level, square_.column);
    square_.column = (square_.column == 0 ? shape().columnsOf(square_.level) : square_.column) - 1;
    return *this;
  }
  Traversal& south() {  // (4.18)
    node_ += differences_->vertical(square_.level, square_.row + 1);
    square_.row = atSouthBorder() ? 0 : square_.row + 1;
    return *this;
  }
  Traversal& north() {  // (4.17)
    node_ -= differences_->vertical(square_.level, square_.row);
    square_.row = (square_.row == 0 ? shape().rowsOf(square_.level) : square_.row) - 1;
    return *this;
  }

  /// One level down: the scaling function (4.23). `child`: 0 ... 3 along the z-curve.
  Traversal& toChild(uint32_t child) {
    node_ = 4 * node_ + child;
    square_ = {square_.level + 1, 2 * square_.column + child % 2, 2 * square_.row + child / 2};
    return *this;
  }

 private:
  const QuadtreeShape& shape() const { return differences_->shape(); }

  const IndexDifferences* differences_;
  Square square_;
  uint32_t node_;
};

}  // namespace tetrakis::inline quadtree
