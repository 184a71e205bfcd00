// SPDX-License-Identifier: Apache-2.0
// AncestorWindow holds all ancestors of a vertex on one level, and gives those on the level above:
// its parents, their parents, and so on up to level 0. Their merging domains hold the vertex
// (thesis 3.3, 5.3.1), so each ancestor has to come exactly once.
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
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline topology {

/// A set of vertices of one level within a window of 8 x 8 cells. Cell (0, 0) of the window is cell
/// (left, top) of the level.
struct AncestorWindow {
  uint64_t cells = 0;
  int32_t left = 0, top = 0;

  bool operator==(const AncestorWindow&) const = default;

  static AncestorWindow ofSquare(Site v) {
    return {1, static_cast<int32_t>(v.column), static_cast<int32_t>(v.row)};
  }
  static AncestorWindow ofMidpoint(Site v);
  /// The parents of these squares: a window of the level of midpoints above.
  AncestorWindow midpointsAbove() const;
  /// The parents of these midpoints: a window of the level of squares above, whose plan is given.
  AncestorWindow squaresAbove(const Lattice::Plan& above) const;

  /// This window without the vertices of another window of the same level.
  AncestorWindow without(const AncestorWindow& other) const;
  /// Calls visitOne(VertexId) for every vertex in the window.
  template <class Visit>
  void visit(uint32_t level, const Lattice::Plan& plan, Visit& visitOne) const;

 private:
  static constexpr uint64_t kOddSum = 0x55aa55aa55aa55aa;
  static constexpr uint64_t kHorizontalEdges = 0x00aa00aa00aa00aa;  ///< odd column, even row
  static constexpr uint64_t kVerticalEdges = 0x5500550055005500;    ///< even column, odd row
  static constexpr uint64_t kCentres = 0xaa00aa00aa00aa00;          ///< odd column, odd row

  void clip(const Lattice::Plan& plan);
};

/// Calls visit(level, AncestorWindow) with the ancestors of v on each level above v, from fine to
/// coarse, up to and with `last`, which is a level of squares.
template <class Visit>
void forEachAncestorWindow(const Lattice& lattice, Site v, uint32_t last, Visit&& visit);

/// Calls visit(VertexId) for every ancestor of v, level by level; v itself is not visited.
template <class Visit>
void forEachAncestor(const Lattice& lattice, Site v, Visit&& visit);

/// Adds amounts to all ancestors of many vertices. Neighbouring vertices share most of their
/// ancestors, so an amount waits at every level of squares until an amount with another window
/// arrives there. Delta has +=.
///
/// visit(VertexId, Delta) is called for each ancestor, during add() or a later call. If the visitor
/// has a function visit.pass(level, squares, taken, Delta), it is called first, with all squares of
/// a level that the amount reaches, those taken included.
template <class Delta>
class AncestorSums {
 public:
  explicit AncestorSums(const Lattice& lattice)
      : lattice_(&lattice),
        waiting_((lattice.levelCount() + 1) / 2),
        taken_(lattice.levelCount()) {}

  /// From now on neither v nor its ancestors are visited. (Descendants of v share most of their
  /// ancestors with it.) visit(level, AncestorWindow) is called as by forEachAncestorWindow().
  template <class Visit>
  void takeAncestorsOf(Site v, uint32_t last, Visit&& visit);
  /// The window of v or its ancestors on a level from `last` on; empty below v.
  const AncestorWindow& taken(uint32_t level) const { return taken_[level]; }
  template <class Visit>
  void add(Site v, const Delta& delta, Visit&& visit);
  /// Visits the ancestors of all amounts that still wait.
  template <class Visit>
  void flush(Visit&& visit);

 private:
  struct Waiting {
    AncestorWindow squares;  ///< empty: nothing waits
    Delta delta{};
  };

  template <class Visit>
  void arrive(size_t pair, Waiting amount, Visit& visit);
  template <class Visit>
  bool rise(size_t pair, Waiting& amount, bool own, Visit& visit);
  void takeAbove(uint32_t level);

  const Lattice* lattice_;
  std::vector<Waiting> waiting_;       ///< of levels 0, 2, 4 ...
  std::vector<AncestorWindow> taken_;  ///< of every level from last_taken_ on; empty: none
  uint32_t last_taken_ = 0;            ///< a level of squares
};

inline AncestorWindow AncestorWindow::ofMidpoint(Site v) {
  assert(!Lattice::isCentre(v.level));
  const auto column = static_cast<int32_t>(v.column), row = static_cast<int32_t>(v.row);
  AncestorWindow w{0, (column - 1) & ~1, (row - 1) & ~1};
  w.cells = uint64_t{1} << (column - w.left + 8 * (row - w.top));
  return w;
}

inline AncestorWindow AncestorWindow::midpointsAbove() const {
  AncestorWindow corners{0, (left - 1) & ~1, (top - 1) & ~1};
  const int32_t shift = left - corners.left + 8 * (top - corners.top);
  assert(shift >= 0 && cells << shift >> shift == cells);
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
  const auto within = [](int32_t i, uint32_t count) { return static_cast<uint32_t>(i) < count; };
  if (within(left, plan.columns) && within(left + 3, plan.columns) && within(top, plan.rows) &&
      within(top + 3, plan.rows))
    return;
  for (int i = 0; i < 4; ++i) {
    if (!within(left + i, plan.columns)) cells &= ~(uint64_t{0x01010101} << i);
    if (!within(top + i, plan.rows)) cells &= ~(uint64_t{0xff} << 8 * i);
  }
}

inline AncestorWindow AncestorWindow::without(const AncestorWindow& other) const {
  constexpr uint64_t kFirstColumn = 0x0101010101010101;
  const int32_t right = other.left - left, down = other.top - top;
  if (right < -7 || right > 7 || down < -7 || down > 7) return *this;
  uint64_t moved = other.cells;
  moved = right < 0 ? moved >> -right & kFirstColumn * (0xff >> -right)
                    : moved << right & kFirstColumn * (0xff << right & 0xff);
  moved = down < 0 ? moved >> 8 * -down : moved << 8 * down;
  return {cells & ~moved, left, top};
}

template <class Visit>
void AncestorWindow::visit(uint32_t level, const Lattice::Plan& plan, Visit& visitOne) const {
  // Half of an even number: the left column and the top row of midpoints are even.
  const int64_t cell = int64_t{top} * plan.columns + left;
  const auto origin =
      static_cast<VertexId>(plan.first + (Lattice::isCentre(level) ? cell : cell / 2));
  for (uint64_t rest = cells; rest != 0; rest &= rest - 1)
    visitOne(VertexId{origin + plan.offsets[static_cast<size_t>(std::countr_zero(rest))]});
}

template <class Visit>
void forEachAncestorWindow(const Lattice& lattice, Site v, uint32_t last, Visit&& visit) {
  assert(Lattice::isCentre(last) && last <= v.level);
  uint32_t level = v.level;
  AncestorWindow squares = AncestorWindow::ofSquare(v);
  if (!Lattice::isCentre(level)) {
    --level;
    squares = AncestorWindow::ofMidpoint(v).squaresAbove(lattice.plan(level));
    visit(level, squares);
  }
  // Both are even. Of `level > last` gcc 12 makes one turn on s390x, from -O2 on, where last is 0.
  for (; level != last; level -= 2) {
    const AncestorWindow midpoints = squares.midpointsAbove();
    visit(level - 1, midpoints);
    squares = midpoints.squaresAbove(lattice.plan(level - 2));
    visit(level - 2, squares);
  }
}

template <class Visit>
void forEachAncestor(const Lattice& lattice, Site v, Visit&& visit) {
  forEachAncestorWindow(lattice, v, 0, [&](uint32_t level, const AncestorWindow& window) {
    window.visit(level, lattice.plan(level), visit);
  });
}

template <class Delta>
template <class Visit>
void AncestorSums<Delta>::takeAncestorsOf(Site v, uint32_t last, Visit&& visit) {
  for (size_t level = v.level + 1; level < taken_.size(); ++level) taken_[level].cells = 0;
  taken_[v.level] =
      Lattice::isCentre(v.level) ? AncestorWindow::ofSquare(v) : AncestorWindow::ofMidpoint(v);
  forEachAncestorWindow(*lattice_, v, last, [&](uint32_t level, const AncestorWindow& window) {
    visit(level, window);
    taken_[level] = window;
  });
  last_taken_ = last;
}

/// The levels that takeAncestorsOf() left out: few amounts rise so far.
template <class Delta>
void AncestorSums<Delta>::takeAbove(uint32_t level) {
  for (; level > 0; level -= 2) {
    taken_[level - 1] = taken_[level].midpointsAbove();
    taken_[level - 2] = taken_[level - 1].squaresAbove(lattice_->plan(level - 2));
  }
  last_taken_ = 0;
}

template <class Delta>
template <class Visit>
void AncestorSums<Delta>::add(Site v, const Delta& delta, Visit&& visit) {
  size_t pair = v.level / 2;
  if (!Lattice::isCentre(v.level)) {
    const Lattice::Plan& above = lattice_->plan(v.level - 1);
    arrive(pair, {AncestorWindow::ofMidpoint(v).squaresAbove(above), delta}, visit);
    return;
  }
  Waiting amount{AncestorWindow::ofSquare(v), delta};
  if (rise(pair, amount, true, visit)) arrive(pair - 1, amount, visit);
}

template <class Delta>
template <class Visit>
void AncestorSums<Delta>::flush(Visit&& visit) {
  for (size_t pair = waiting_.size(); pair-- > 0;) {
    Waiting amount = std::exchange(waiting_[pair], {});
    if (amount.squares.cells != 0 && rise(pair, amount, false, visit))
      arrive(pair - 1, amount, visit);
  }
}

/// What waited until now goes on.
template <class Delta>
template <class Visit>
void AncestorSums<Delta>::arrive(size_t pair, Waiting amount, Visit& visit) {
  for (;; --pair) {
    Waiting& waiting = waiting_[pair];
    if (waiting.squares == amount.squares) {
      waiting.delta += amount.delta;
      return;
    }
    std::swap(waiting, amount);
    if (amount.squares.cells == 0 || !rise(pair, amount, false, visit)) return;
  }
}

/// Goes from squares to the squares above; false if there are none to go on to. own: the square is
/// the vertex itself.
template <class Delta>
template <class Visit>
bool AncestorSums<Delta>::rise(size_t pair, Waiting& amount, bool own, Visit& visit) {
  const auto level = static_cast<uint32_t>(2 * pair);
  const AncestorWindow others = amount.squares.without(taken_[level]);
  if (others.cells == 0) return false;  // their ancestors are taken, too
  if constexpr (requires { visit.pass(level, others, others, amount.delta); })
    visit.pass(level, amount.squares, taken_[level], amount.delta);
  const auto visitOne = [&](VertexId a) { visit(a, amount.delta); };
  if (!own) others.visit(level, lattice_->plan(level), visitOne);
  if (pair == 0) return false;
  if (level == last_taken_) takeAbove(level);
  const AncestorWindow midpoints = amount.squares.midpointsAbove();
  midpoints.without(taken_[level - 1]).visit(level - 1, lattice_->plan(level - 1), visitOne);
  amount.squares = midpoints.squaresAbove(lattice_->plan(level - 2));
  return true;
}

}  // namespace tetrakis::inline topology
