// SPDX-License-Identifier: Apache-2.0
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
#pragma once

#include <bit>
#include <cassert>
#include <cstdint>

namespace tetrakis::inline quadtree {

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

}  // namespace tetrakis::inline quadtree
