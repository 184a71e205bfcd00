// SPDX-License-Identifier: Apache-2.0
// All ancestors of a vertex: its parents, their parents, and so on up to level 0
// (thesis 3.3, 5.3.1: the vertices whose merging domains hold v), each exactly once, level by
// level.
//
// On one level the ancestors lie in a small octagon: at most 4 x 4 squares, 5 x 5 corners of them.
// So a level is one 64-bit window of 8 x 8 cells, bit 8 * row + column, and one level follows from
// the one below by shifts, which also removes duplicates:
//
//   squares -> midpoints: a square's parents are its two corners of odd coordinate sum
//   midpoints -> squares: a midpoint's parents are the squares on either side of its edge
//
// The window of a level of midpoints starts at even coordinates, so that parity is a constant mask,
// and its first column and row stay empty, so that no shift leaves the window.
#pragma once

#include <bit>
#include <cstdint>

#include "codec/lattice.hpp"

namespace tetrakis {

class AncestorWalk {
 public:
  explicit AncestorWalk(const Lattice& lattice) : lattice_(&lattice) {}

  /// visit(VertexId) for every ancestor of v; v itself is not visited.
  template <class Visit>
  void forEach(Site v, Visit&& visit) const;

 private:
  /// Cell (0, 0) of `cells` is (left, top) of the level.
  struct Window {
    uint64_t cells = 0;
    int64_t left = 0, top = 0;
  };
  static constexpr uint64_t kOddSum = 0x55aa55aa55aa55aa;
  static constexpr uint64_t kHorizontalEdges = 0x00aa00aa00aa00aa;  ///< odd column, even row
  static constexpr uint64_t kVerticalEdges = 0x5500550055005500;    ///< even column, odd row
  static constexpr uint64_t kCentres = 0xaa00aa00aa00aa00;          ///< odd column, odd row

  static Window midpointsAbove(const Window& squares);
  static Window squaresAbove(const Window& midpoints);
  static void clip(const Lattice::Plan& plan, Window& squares);
  template <class Visit>
  static void visitSquares(const Lattice::Plan& plan, const Window& squares, Visit& visit);
  template <class Visit>
  static void visitMidpoints(const Lattice::Plan& plan, const Window& midpoints, Visit& visit);

  const Lattice* lattice_;
};

inline AncestorWalk::Window AncestorWalk::midpointsAbove(const Window& squares) {
  Window corners{0, (squares.left - 1) & ~int64_t{1}, (squares.top - 1) & ~int64_t{1}};
  const int64_t shift = squares.left - corners.left + 8 * (squares.top - corners.top);
  const uint64_t s = squares.cells;
  corners.cells = (s | s << 1 | s << 8 | s << 9) << shift & kOddSum;
  return corners;
}

inline AncestorWalk::Window AncestorWalk::squaresAbove(const Window& midpoints) {
  const uint64_t h = midpoints.cells & kHorizontalEdges, v = midpoints.cells & kVerticalEdges;
  uint64_t c = (h << 8 | h >> 8 | v << 1 | v >> 1) & kCentres;
  // Odd columns 1 3 5 7 of odd rows 1 3 5 7 become columns and rows 0 1 2 3.
  c >>= 9;
  c = (c | c >> 1) & 0x0033003300330033;
  c = (c | c >> 2) & 0x000f000f000f000f;
  c = (c | c >> 8) & 0x00000f0f00000f0f;
  c = (c | c >> 16) & 0x000000000f0f0f0f;
  return {c, midpoints.left / 2, midpoints.top / 2};
}

inline void AncestorWalk::clip(const Lattice::Plan& plan, Window& squares) {
  const auto within = [](int64_t origin, uint32_t count, int64_t i) {
    return origin + i >= 0 && origin + i < count;
  };
  if (within(squares.left, plan.columns, 0) && within(squares.left, plan.columns, 3) &&
      within(squares.top, plan.rows, 0) && within(squares.top, plan.rows, 3))
    return;
  for (int i = 0; i < 4; ++i) {
    if (!within(squares.left, plan.columns, i)) squares.cells &= ~(uint64_t{0x01010101} << i);
    if (!within(squares.top, plan.rows, i)) squares.cells &= ~(uint64_t{0xff} << 8 * i);
  }
}

template <class Visit>
void AncestorWalk::visitSquares(const Lattice::Plan& plan, const Window& squares, Visit& visit) {
  const int64_t origin = plan.first + squares.top * plan.columns + squares.left;
  for (uint64_t left = squares.cells; left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    visit(static_cast<VertexId>(origin + (bit >> 3) * int64_t{plan.columns} + (bit & 7)));
  }
}

template <class Visit>
void AncestorWalk::visitMidpoints(const Lattice::Plan& plan, const Window& midpoints,
                                  Visit& visit) {
  const int64_t origin = midpoints.top * plan.columns + midpoints.left;
  for (uint64_t left = midpoints.cells; left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    const int64_t cell = origin + (bit >> 3) * int64_t{plan.columns} + (bit & 7);
    visit(static_cast<VertexId>(plan.first + (cell >> 1)));
  }
}

template <class Visit>
void AncestorWalk::forEach(Site v, Visit&& visit) const {
  uint32_t level = v.level;
  Window squares{1, v.column, v.row}, midpoints;
  const auto toSquares = [&] {
    --level;
    squares = squaresAbove(midpoints);
    clip(lattice_->plan(level), squares);
    visitSquares(lattice_->plan(level), squares, visit);
  };
  if (!Lattice::isCentre(level)) {
    midpoints.left = (int64_t{v.column} - 1) & ~int64_t{1};
    midpoints.top = (int64_t{v.row} - 1) & ~int64_t{1};
    midpoints.cells = uint64_t{1} << (v.column - midpoints.left + 8 * (v.row - midpoints.top));
    toSquares();
  }
  while (level > 0) {
    --level;
    midpoints = midpointsAbove(squares);
    visitMidpoints(lattice_->plan(level), midpoints, visit);
    toSquares();
  }
}

}  // namespace tetrakis
