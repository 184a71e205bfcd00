// SPDX-License-Identifier: Apache-2.0
// Lattice is the 4-8 lattice of a W x H grid of samples: a forest of root squares (thesis 3.2,
// 3.3.2). It numbers the vertices and tells where their parents, children and neighbours are.
//
// Roots are squares of side 2^d, d = ceil(log2(min(W, H) - 1)): one along the short side, as many
// as needed along the long one. Every step s = 2^(d-1) ... 1 inserts two levels of vertices:
//
//   o---.---o     o  corners, at multiples of 2s: roots and coarser vertices
//   | \ | / |     c  centres (thesis: odd l), at odd multiples of s in x and y
//   .---c---.     .  midpoints (thesis: even l), at multiples of s of odd coordinate sum
//   | / | \ |
//   o---.---o     The diagonal that c splits ends in the two corners of even coordinate sum.
//
// A vertex splits the hypotenuse of one or two triangles; the apexes of these are its parents.
//
// Overhang. Where W - 1 or H - 1 is no multiple of 2^d the forest reaches over the grid, and
// vertices beyond it are clamped: x -> min(x, W - 1), y -> min(y, H - 1). The map is monotone per
// axis, so no triangle flips; a triangle without a point left of x = W - 1 and above y = H - 1 has
// no area and is hidden. Hidden triangles belong to no mesh and need no vertices: the lattice holds
// only the vertices that split a visible triangle, and gives them only those parents that are
// apexes of visible triangles. Every sample is a root or the place of exactly one vertex that is
// not hidden(). A hidden vertex falls onto a corner of the triangles that it splits.
//
// Of meshes, only this file knows where neighbours are; all other code walks parents, children and
// ancestors. Masks use the same vertices under another border rule (codec/lattice/levels.hpp).
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/lattice/levels.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline topology {

/// Lattice vertices other than roots, level after level from coarse to fine: parents before
/// children.
using VertexId = uint32_t;

struct GridPoint {
  uint32_t x = 0, y = 0;
  bool operator==(const GridPoint&) const = default;
};

/// Where a vertex is in its level. Even level (0-based): centre of square (column, row) of side 2s.
/// Odd level: midpoint at (column * s, row * s); column + row is odd.
struct Site {
  uint32_t level = 0, column = 0, row = 0;
  bool operator==(const Site&) const = default;
};

class Lattice {
 public:
  /// TKS_USAGE below 2 x 2, TKS_LIMIT above 2^31 samples (triangles are counted in 32 bits).
  static Result<Lattice> make(uint32_t width, uint32_t height);

  uint32_t width() const { return right_ + 1; }
  uint32_t height() const { return bottom_ + 1; }
  size_t sampleCount() const { return size_t{width()} * height(); }
  uint32_t vertexCount() const { return vertex_count_; }
  uint32_t levelCount() const { return static_cast<uint32_t>(levels_.size()); }
  uint32_t rootSide() const { return root_side_; }
  uint32_t rootColumns() const { return (right_ - 1) / root_side_ + 1; }  ///< squares, not corners
  uint32_t rootRows() const { return (bottom_ - 1) / root_side_ + 1; }

  VertexId id(Site v) const;
  Site site(VertexId vertex) const;
  /// The id of the first vertex of a level, 0 ... levelCount(); of levelCount() it is
  /// vertexCount().
  VertexId firstOf(uint32_t level) const;

  /// The place of a vertex on the lattice, before clamping: it may lie outside the grid.
  GridPoint position(Site v) const;
  /// The vertex of `level` at a lattice point.
  Site siteAt(uint32_t level, GridPoint point) const;
  GridPoint clamp(GridPoint point) const;
  /// Sample (row * width + column) of a lattice point, clamped.
  uint32_t gridIndex(GridPoint point) const;

  /// Whether the triangle with these corners (before clamping) has no area once it is clamped.
  bool collapses(GridPoint a, GridPoint b, GridPoint c) const;
  /// Whether clamping moves a corner of this triangle.
  bool overhangs(GridPoint a, GridPoint b, GridPoint c) const;
  /// Whether the vertex is clamped onto a corner of the triangles that it splits. Such a vertex
  /// adds no sample to a mesh. It changes the triangles of a mesh only if both of its coordinates
  /// are clamped: then it may turn a diagonal.
  bool hidden(Site v) const;
  /// The number of triangles that a mesh gains when the vertex is inserted: 0, 1 or 2.
  uint32_t triangleCost(Site v) const;

  /// Calls visit(Site) for each of the one or two parents of v. Vertices of level 0 have none.
  template <class Visit>
  void forEachParent(Site v, Visit&& visit) const;
  /// Calls visit(Site) for each of the up to four vertices that v is a parent of.
  template <class Visit>
  void forEachChild(Site v, Visit&& visit) const;
  /// Calls visit(Site, VertexId) for every vertex, in the order of their ids.
  template <class Visit>
  void forEachVertex(Visit&& visit) const;

  struct Plan {
    uint32_t first = 0;    ///< id of the level's first vertex
    uint32_t step = 1;     ///< s
    uint32_t columns = 0;  ///< centres: squares in a row; midpoints: multiples of s, 0 included
    uint32_t rows = 0;
    uint32_t shift = 0;  ///< log2 s
    /// Ids in an 8 x 8 window (ancestors.hpp): of cell 8 * row + column, from that of cell 0, whose
    /// coordinates are even on levels of midpoints.
    std::array<uint32_t, 64> offsets{};
  };
  static constexpr bool isCentre(uint32_t level) { return level % 2 == 0; }
  const Plan& plan(uint32_t level) const { return levels_[level]; }

 private:
  Lattice(uint32_t width, uint32_t height);
  void addLevels();
  void addLevel(Plan plan);

  uint32_t right_, bottom_;  ///< last column and row of the grid
  uint32_t root_side_ = 1;
  uint32_t vertex_count_ = 0;
  std::vector<Plan> levels_;
};

inline VertexId Lattice::id(Site v) const {
  assert(v.level < levelCount());
  const Plan& plan = levels_[v.level];
  assert(v.column < plan.columns && v.row < plan.rows);
  assert(isCentre(v.level) || (v.column + v.row) % 2 == 1);
  const size_t cell = size_t{v.row} * plan.columns + v.column;
  // Every other cell of a level of midpoints is empty: halving packs the others without gaps.
  return plan.first + static_cast<VertexId>(isCentre(v.level) ? cell : cell / 2);
}

inline Site Lattice::site(VertexId vertex) const {
  assert(vertex < vertex_count_);
  uint32_t level = levelCount() - 1;
  while (vertex < levels_[level].first) --level;
  const Plan& plan = levels_[level];
  const uint32_t cell = vertex - plan.first;
  if (isCentre(level)) return {level, cell % plan.columns, cell / plan.columns};
  const uint32_t wide = 2 * cell + 1;  // cells are half of at most 2^31 samples and a few more
  Site v{level, wide % plan.columns, wide / plan.columns};
  if ((v.column + v.row) % 2 == 0) --v.column;
  return v;
}

inline VertexId Lattice::firstOf(uint32_t level) const {
  return level < levelCount() ? levels_[level].first : vertex_count_;
}

inline GridPoint Lattice::position(Site v) const {
  const uint32_t step = levels_[v.level].step;
  if (isCentre(v.level)) return {centreAt(step, v.column), centreAt(step, v.row)};
  return {v.column * step, v.row * step};
}

inline Site Lattice::siteAt(uint32_t level, GridPoint point) const {
  const uint32_t shift = levels_[level].shift + (isCentre(level) ? 1 : 0);
  return {level, point.x >> shift, point.y >> shift};
}

inline GridPoint Lattice::clamp(GridPoint point) const {
  return {point.x < right_ ? point.x : right_, point.y < bottom_ ? point.y : bottom_};
}

inline uint32_t Lattice::gridIndex(GridPoint point) const {
  const GridPoint sample = clamp(point);
  return sample.y * width() + sample.x;
}

inline bool Lattice::collapses(GridPoint a, GridPoint b, GridPoint c) const {
  return (a.x >= right_ && b.x >= right_ && c.x >= right_) ||
         (a.y >= bottom_ && b.y >= bottom_ && c.y >= bottom_);
}

inline bool Lattice::overhangs(GridPoint a, GridPoint b, GridPoint c) const {
  return a.x > right_ || b.x > right_ || c.x > right_ || a.y > bottom_ || b.y > bottom_ ||
         c.y > bottom_;
}

inline bool Lattice::hidden(Site v) const {
  const GridPoint p = position(v);
  if (isCentre(v.level)) return p.x >= right_ && p.y >= bottom_;
  return v.column % 2 == 1 ? p.x >= right_
                           : p.y >= bottom_;  // splits a horizontal or a vertical edge
}

inline uint32_t Lattice::triangleCost(Site v) const {
  const GridPoint p = position(v);
  // Two triangles become four, less those to the right of, or below, a centre on the border.
  if (isCentre(v.level)) return (p.x < right_ ? 1 : 0) + (p.y < bottom_ ? 1 : 0);
  if (hidden(v)) return 0;
  uint32_t parents = 0;
  forEachParent(v, [&](Site) { ++parents; });
  return parents;
}

template <class Visit>
void Lattice::forEachParent(Site v, Visit&& visit) const {
  if (v.level == 0) return;
  const uint32_t level = v.level - 1;
  if (isCentre(v.level)) {  // the corners of odd coordinate sum
    const uint32_t odd = (v.column + v.row) % 2;
    visit(Site{level, v.column + 1 - odd, v.row});
    visit(Site{level, v.column + odd, v.row + 1});
    return;
  }
  const Plan& above = levels_[level];
  const uint32_t column = v.column / 2, row = v.row / 2;
  if (v.column % 2 == 1) {  // horizontal edge: the squares above and below
    if (row > 0) visit(Site{level, column, row - 1});
    if (row < above.rows) visit(Site{level, column, row});
  } else {  // vertical edge: the squares to the left and to the right
    if (column > 0) visit(Site{level, column - 1, row});
    if (column < above.columns) visit(Site{level, column, row});
  }
}

template <class Visit>
void Lattice::forEachChild(Site v, Visit&& visit) const {
  const uint32_t level = v.level + 1;
  if (level == levelCount()) return;
  const Plan& below = levels_[level];
  if (isCentre(v.level)) {  // the midpoints of the square's edges
    visit(Site{level, 2 * v.column + 1, 2 * v.row});
    visit(Site{level, 2 * v.column, 2 * v.row + 1});
    if (2 * v.column + 2 < below.columns) visit(Site{level, 2 * v.column + 2, 2 * v.row + 1});
    if (2 * v.row + 2 < below.rows) visit(Site{level, 2 * v.column + 1, 2 * v.row + 2});
    return;
  }
  // The four squares of side s that meet in v.
  const bool left = v.column > 0, right = v.column < below.columns;
  if (v.row > 0 && left) visit(Site{level, v.column - 1, v.row - 1});
  if (v.row > 0 && right) visit(Site{level, v.column, v.row - 1});
  if (v.row < below.rows && left) visit(Site{level, v.column - 1, v.row});
  if (v.row < below.rows && right) visit(Site{level, v.column, v.row});
}

template <class Visit>
void Lattice::forEachVertex(Visit&& visit) const {
  VertexId vertex = 0;
  for (uint32_t level = 0; level < levelCount(); ++level)
    for (uint32_t row = 0; row < levels_[level].rows; ++row) {
      const bool centre = isCentre(level);
      for (uint32_t column = centre || row % 2 == 1 ? 0 : 1; column < levels_[level].columns;
           column += centre ? 1 : 2)
        visit(Site{level, column, row}, vertex++);
    }
}

}  // namespace tetrakis::inline topology
