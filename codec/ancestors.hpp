// SPDX-License-Identifier: Apache-2.0
// All ancestors of a vertex: its parents, their parents, and so on up to level 0
// (thesis 3.3, 5.3.1: the vertices whose merging domains hold v), each exactly once.
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
#include <vector>

#include "codec/lattice.hpp"

namespace tetrakis {

/// Cell (0, 0) is (left, top) of the level.
struct AncestorWindow {
  uint64_t cells = 0;
  int64_t left = 0, top = 0;

  bool operator==(const AncestorWindow&) const = default;

  static AncestorWindow ofSquare(Site v) { return {1, v.column, v.row}; }
  static AncestorWindow ofMidpoint(Site v);
  /// Of a level of squares, the level of midpoints above it.
  AncestorWindow midpointsAbove() const;
  /// Of a level of midpoints, the level of squares above it.
  AncestorWindow squaresAbove(const Lattice::Plan& above) const;

  template <class Visit>
  void visitSquares(const Lattice::Plan& plan, Visit& visit) const;
  template <class Visit>
  void visitMidpoints(const Lattice::Plan& plan, Visit& visit) const;

 private:
  static constexpr uint64_t kOddSum = 0x55aa55aa55aa55aa;
  static constexpr uint64_t kHorizontalEdges = 0x00aa00aa00aa00aa;  ///< odd column, even row
  static constexpr uint64_t kVerticalEdges = 0x5500550055005500;    ///< even column, odd row
  static constexpr uint64_t kCentres = 0xaa00aa00aa00aa00;          ///< odd column, odd row

  void clip(const Lattice::Plan& plan);
};

/// visit(VertexId) for every ancestor of v, level by level; v itself is not visited.
template <class Visit>
void forEachAncestor(const Lattice& lattice, Site v, Visit&& visit);

/// Adds amounts to many vertices and all their ancestors. Neighbours share most of their ancestors:
/// amounts wait at every level of squares until one with another window arrives. Delta has +=.
template <class Delta>
class AncestorSums {
 public:
  explicit AncestorSums(const Lattice& lattice)
      : lattice_(&lattice), waiting_((lattice.levelCount() + 1) / 2) {}

  /// visit(VertexId, Delta) may follow now or later, for v too.
  template <class Visit>
  void add(Site v, const Delta& delta, Visit&& visit);
  /// Visits all that waits.
  template <class Visit>
  void flush(Visit&& visit);

 private:
  struct Waiting {
    AncestorWindow squares;  ///< empty: nothing waits
    Delta delta{};
  };

  template <class Visit>
  void arrive(size_t pair, const AncestorWindow& squares, const Delta& delta, Visit& visit);
  template <class Visit>
  void rise(size_t pair, Visit& visit);

  const Lattice* lattice_;
  std::vector<Waiting> waiting_;  ///< of levels 0, 2, 4 ...
};

inline AncestorWindow AncestorWindow::ofMidpoint(Site v) {
  AncestorWindow w{0, (int64_t{v.column} - 1) & ~int64_t{1}, (int64_t{v.row} - 1) & ~int64_t{1}};
  w.cells = uint64_t{1} << (v.column - w.left + 8 * (v.row - w.top));
  return w;
}

inline AncestorWindow AncestorWindow::midpointsAbove() const {
  AncestorWindow corners{0, (left - 1) & ~int64_t{1}, (top - 1) & ~int64_t{1}};
  const int64_t shift = left - corners.left + 8 * (top - corners.top);
  corners.cells = (cells | cells << 1 | cells << 8 | cells << 9) << shift & kOddSum;
  return corners;
}

inline AncestorWindow AncestorWindow::squaresAbove(const Lattice::Plan& above) const {
  const uint64_t h = cells & kHorizontalEdges, v = cells & kVerticalEdges;
  uint64_t c = (h << 8 | h >> 8 | v << 1 | v >> 1) & kCentres;
  // Odd columns 1 3 5 7 of odd rows 1 3 5 7 become columns and rows 0 1 2 3.
  c >>= 9;
  c = (c | c >> 1) & 0x0033003300330033;
  c = (c | c >> 2) & 0x000f000f000f000f;
  c = (c | c >> 8) & 0x00000f0f00000f0f;
  c = (c | c >> 16) & 0x000000000f0f0f0f;
  AncestorWindow squares{c, left / 2, top / 2};
  squares.clip(above);
  return squares;
}

inline void AncestorWindow::clip(const Lattice::Plan& plan) {
  const auto within = [](int64_t i, uint32_t count) { return i >= 0 && i < count; };
  if (within(left, plan.columns) && within(left + 3, plan.columns) && within(top, plan.rows) &&
      within(top + 3, plan.rows))
    return;
  for (int i = 0; i < 4; ++i) {
    if (!within(left + i, plan.columns)) cells &= ~(uint64_t{0x01010101} << i);
    if (!within(top + i, plan.rows)) cells &= ~(uint64_t{0xff} << 8 * i);
  }
}

template <class Visit>
void AncestorWindow::visitSquares(const Lattice::Plan& plan, Visit& visit) const {
  const int64_t origin = plan.first + top * plan.columns + left;
  for (uint64_t rest = cells; rest != 0; rest &= rest - 1) {
    const int bit = std::countr_zero(rest);
    visit(static_cast<VertexId>(origin + (bit >> 3) * int64_t{plan.columns} + (bit & 7)));
  }
}

template <class Visit>
void AncestorWindow::visitMidpoints(const Lattice::Plan& plan, Visit& visit) const {
  const int64_t origin = top * plan.columns + left;
  for (uint64_t rest = cells; rest != 0; rest &= rest - 1) {
    const int bit = std::countr_zero(rest);
    const int64_t cell = origin + (bit >> 3) * int64_t{plan.columns} + (bit & 7);
    visit(static_cast<VertexId>(plan.first + (cell >> 1)));
  }
}

template <class Visit>
void forEachAncestor(const Lattice& lattice, Site v, Visit&& visit) {
  uint32_t level = v.level;
  AncestorWindow squares = AncestorWindow::ofSquare(v);
  if (!Lattice::isCentre(level)) {
    --level;
    squares = AncestorWindow::ofMidpoint(v).squaresAbove(lattice.plan(level));
    squares.visitSquares(lattice.plan(level), visit);
  }
  for (; level > 0; level -= 2) {
    const AncestorWindow midpoints = squares.midpointsAbove();
    midpoints.visitMidpoints(lattice.plan(level - 1), visit);
    squares = midpoints.squaresAbove(lattice.plan(level - 2));
    squares.visitSquares(lattice.plan(level - 2), visit);
  }
}

template <class Delta>
template <class Visit>
void AncestorSums<Delta>::add(Site v, const Delta& delta, Visit&& visit) {
  const size_t pair = v.level / 2;
  if (Lattice::isCentre(v.level)) {
    arrive(pair, AncestorWindow::ofSquare(v), delta, visit);
    return;
  }
  visit(lattice_->id(v), delta);
  arrive(pair, AncestorWindow::ofMidpoint(v).squaresAbove(lattice_->plan(v.level - 1)), delta,
         visit);
}

template <class Delta>
template <class Visit>
void AncestorSums<Delta>::flush(Visit&& visit) {
  for (size_t pair = waiting_.size(); pair-- > 0;) rise(pair, visit);
}

template <class Delta>
template <class Visit>
void AncestorSums<Delta>::arrive(size_t pair, const AncestorWindow& squares, const Delta& delta,
                                 Visit& visit) {
  Waiting& waiting = waiting_[pair];
  if (waiting.squares == squares) {
    waiting.delta += delta;
    return;
  }
  rise(pair, visit);
  waiting = {squares, delta};
}

template <class Delta>
template <class Visit>
void AncestorSums<Delta>::rise(size_t pair, Visit& visit) {
  Waiting& waiting = waiting_[pair];
  if (waiting.squares.cells == 0) return;
  const auto level = static_cast<uint32_t>(2 * pair);
  const auto visitOne = [&](VertexId a) { visit(a, waiting.delta); };
  waiting.squares.visitSquares(lattice_->plan(level), visitOne);
  if (pair > 0) {
    const AncestorWindow midpoints = waiting.squares.midpointsAbove();
    midpoints.visitMidpoints(lattice_->plan(level - 1), visitOne);
    arrive(pair - 1, midpoints.squaresAbove(lattice_->plan(level - 2)), waiting.delta, visit);
  }
  waiting.squares.cells = 0;
}

}  // namespace tetrakis
