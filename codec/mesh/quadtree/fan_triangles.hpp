// SPDX-License-Identifier: Apache-2.0
// FanTriangles lists the triangles of those nodes of a quadtree that a raster touches. It descends
// the patches, and each node gives one fan of triangles, as mesh_tree.hpp draws it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codec/mesh/quadtree/location_code.hpp"
#include "codec/mesh/quadtree/mesh_tree.hpp"
#include "codec/mesh/quadtree/semilinear_quadtree.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline quadtree {

/// A corner of a triangle: its place on the lattice, before clamping, and its vertex number. Where
/// the vertex is hidden, the number is that of the vertex that it falls onto.
struct FanCorner {
  GridPoint point;
  uint32_t number = kNoVertex;
};

class FanTriangles {
 public:
  /// All arguments must outlive this object.
  FanTriangles(const Lattice& lattice, const SemilinearQuadtree& quadtree,
               const IndexDifferences& differences, const ViewRaster& raster)
      : lattice_(lattice), quadtree_(quadtree), differences_(differences), raster_(raster) {
    for (uint32_t level = 0; level < quadtree.shape().depth; ++level)
      cursors_.push_back({LevelCursor(quadtree.nodes(level)), LevelCursor(quadtree.nodes(level)),
                          LevelCursor(quadtree.nodes(level))});
  }

  /// visit(FanCorner) for the three corners of each triangle, counter-clockwise seen from above.
  template <class Visit>
  void forEach(Visit&& visit) {
    for (uint32_t row = raster_.firstRow(0); row < raster_.endRow(0); ++row) {
      const ViewRaster::Span span = raster_.span(0, row);
      Traversal patch(differences_, {0, span.first, row});
      for (uint32_t column = span.first; column <= span.last; ++column, patch.east())
        addPatch(patch, visit);
    }
  }

 private:
  /// Corners of a square and midpoints of its sides, counter-clockwise from the north-west: side k
  /// runs from corner k to corner k + 1.
  enum { kNorthWest = 0, kSouthWest = 1, kSouthEast = 2, kNorthEast = 3 };
  enum { kWestSide = 0, kSouthSide = 1, kEastSide = 2, kNorthSide = 3 };
  using Ring = std::array<FanCorner, 4>;

  /// The z-curve visits the nodes of a level in ascending order, and so their neighbours nearly.
  struct Cursors {
    LevelCursor<3> node, east, south;
  };

  template <class Visit>
  void addPatch(const Traversal& patch, Visit& visit);
  template <class Visit>
  void addFan(const Traversal& node, const Ring& corners, Visit& visit);
  template <class Visit>
  void addTriangle(const FanCorner& a, const FanCorner& b, const FanCorner& c, Visit& visit) const {
    if (lattice_.collapses(a.point, b.point, c.point)) return;
    visit(a), visit(b), visit(c);
  }

  FanCorner centreOf(const Square& square, uint32_t number, const Ring& corners) const;
  /// The midpoints of the sides; the number of a midpoint that is not there is kNoVertex.
  Ring sidesOf(const Traversal& node, const Ring& corners, uint32_t north, uint32_t west);
  uint32_t eastNumber(const Traversal& node);
  uint32_t southNumber(const Traversal& node);
  /// Bit k says whether the child at corner k is there.
  uint32_t childrenOf(const Traversal& node);

  const Lattice& lattice_;
  const SemilinearQuadtree& quadtree_;
  const IndexDifferences& differences_;
  const ViewRaster& raster_;
  std::vector<Cursors> cursors_;
};

inline FanCorner FanTriangles::centreOf(const Square& square, uint32_t number,
                                        const Ring& corners) const {
  const Site site{2 * square.level, square.column, square.row};
  return {lattice_.position(site), lattice_.hidden(site) ? corners[kSouthEast].number : number};
}

inline uint32_t FanTriangles::eastNumber(const Traversal& node) {
  const auto [level, column, row] = node.square();
  if (column + 1 == lattice_.plan(2 * level).columns)
    return quadtree_.eastBorder(level).find(row, 0);
  return cursors_[level].east.number(Traversal(node).east().node(), kWest);
}

inline uint32_t FanTriangles::southNumber(const Traversal& node) {
  const auto [level, column, row] = node.square();
  if (row + 1 == lattice_.plan(2 * level).rows) return quadtree_.southBorder(level).find(column, 0);
  return cursors_[level].south.number(Traversal(node).south().node(), kNorth);
}

inline FanTriangles::Ring FanTriangles::sidesOf(const Traversal& node, const Ring& corners,
                                                uint32_t north, uint32_t west) {
  const auto between = [&](const FanCorner& from, const FanCorner& to, bool falls_onto_to,
                           uint32_t number) {
    const GridPoint middle{(from.point.x + to.point.x) / 2, (from.point.y + to.point.y) / 2};
    const bool horizontal = from.point.y == to.point.y;
    const bool hidden =
        horizontal ? middle.x + 1 >= lattice_.width() : middle.y + 1 >= lattice_.height();
    if (number != kNoVertex && hidden) number = falls_onto_to ? to.number : from.number;
    return FanCorner{middle, number};
  };
  // A hidden midpoint falls onto the southern or eastern end of its side.
  return {between(corners[kNorthWest], corners[kSouthWest], true, west),
          between(corners[kSouthWest], corners[kSouthEast], true, southNumber(node)),
          between(corners[kSouthEast], corners[kNorthEast], false, eastNumber(node)),
          between(corners[kNorthEast], corners[kNorthWest], false, north)};
}

inline uint32_t FanTriangles::childrenOf(const Traversal& node) {
  const uint32_t level = node.square().level + 1;
  if (level == quadtree_.shape().depth) return 0;
  const uint32_t first = 4 * node.node();
  const QuadtreeTile<3>& tile = cursors_[level].node.tileOf(first);
  const auto z = static_cast<uint32_t>(tile.nodes() >> first % QuadtreeTile<3>::kNodes & 15);
  // From the z-curve (nw, ne, sw, se) to the order of the ring (nw, sw, se, ne).
  return (z & 1) | (z >> 1 & 2) | (z >> 1 & 4) | (z << 2 & 8);
}

template <class Visit>
void FanTriangles::addPatch(const Traversal& patch, Visit& visit) {
  const auto [level, column, row] = patch.square();
  const uint32_t side = lattice_.rootSide();
  const auto root = [&](uint32_t c, uint32_t r) {
    return FanCorner{{c * side, r * side}, r * (lattice_.rootColumns() + 1) + c};
  };
  const Ring corners{root(column, row), root(column, row + 1), root(column + 1, row + 1),
                     root(column + 1, row)};
  const bool split = !cursors_.empty() &&
                     (cursors_[0].node.tileOf(patch.node()).nodes() >> patch.node() % 64 & 1) != 0;
  if (split) return addFan(patch, corners, visit);
  const uint32_t turned = (row + column) % 2;  // the diagonal ends in corners turned and turned + 2
  addTriangle(corners[turned], corners[turned + 1], corners[turned + 2], visit);
  addTriangle(corners[turned + 2], corners[(turned + 3) % 4], corners[turned], visit);
}

template <class Visit>
void FanTriangles::addFan(const Traversal& node, const Ring& corners, Visit& visit) {
  const auto [level, column, row] = node.square();
  const auto [own, north, west] = cursors_[level].node.numbers(node.node());
  const FanCorner centre = centreOf(node.square(), own, corners);
  const Ring sides = sidesOf(node, corners, north, west);
  const uint32_t children = childrenOf(node);
  std::array<bool, 4> seen, here;  // quadrants that are seen; those without a fan of their own
  for (uint32_t k = 0; k < 4; ++k) {
    const uint32_t east = k == kSouthEast || k == kNorthEast;
    const uint32_t south = k == kSouthWest || k == kSouthEast;
    seen[k] = raster_.touches({level + 1, 2 * column + east, 2 * row + south});
    here[k] = seen[k] && (children >> k & 1) == 0;
  }
  for (uint32_t k = 0; k < 4; ++k) {
    const uint32_t next = (k + 1) % 4;
    if (sides[k].number == kNoVertex) {
      if (seen[k] || seen[next]) addTriangle(corners[k], corners[next], centre, visit);
      continue;
    }
    if (here[k]) addTriangle(corners[k], sides[k], centre, visit);
    if (here[next]) addTriangle(sides[k], corners[next], centre, visit);
  }
  const auto descend = [&](uint32_t k, uint32_t child, const Ring& ring) {
    if (seen[k] && !here[k]) addFan(Traversal(node).toChild(child), ring, visit);
  };
  descend(kNorthWest, 0, {corners[kNorthWest], sides[kWestSide], centre, sides[kNorthSide]});
  descend(kNorthEast, 1, {sides[kNorthSide], centre, sides[kEastSide], corners[kNorthEast]});
  descend(kSouthWest, 2, {sides[kWestSide], corners[kSouthWest], sides[kSouthSide], centre});
  descend(kSouthEast, 3, {centre, sides[kSouthSide], corners[kSouthEast], sides[kEastSide]});
}

}  // namespace tetrakis::inline quadtree
