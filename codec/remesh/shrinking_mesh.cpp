// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/shrinking_mesh.hpp"

#include <algorithm>

namespace tetrakis::inline remesh {

ShrinkingMesh::ShrinkingMesh(const TriangleMesh& mesh)
    : triangles_(mesh.triangles),
      opposite_(gluedSides(mesh.triangles).opposite),
      first_side_(mesh.points.size(), kNone),
      neighbours_(mesh.points.size()),
      triangle_count_(static_cast<uint32_t>(mesh.triangles.size())) {
  for (uint32_t side = 0; side < opposite_.size(); ++side) {
    const uint32_t start = startOf(triangles_, side);
    const bool boundary = opposite_[side] == kNone;
    ++neighbours_[start];
    if (boundary) ++neighbours_[startOf(triangles_, nextSide(side))];
    if (boundary || first_side_[start] == kNone) first_side_[start] = side;
  }
}

bool ShrinkingMesh::findRing(uint32_t point, Ring& ring) const {
  if (neighbours_[point] == 0 || neighbours_[point] > kMostNeighbours) return false;
  ring.centre = point;
  ring.sides.clear();
  ring.points.clear();
  const uint32_t first = first_side_[point];
  uint32_t side = first;
  do {
    ring.sides.push_back(side);
    ring.points.push_back(startOf(triangles_, nextSide(side)));
    side = opposite_[previousSide(side)];
  } while (side != first && side != kNone);
  ring.closed = side == first;
  if (!ring.closed) ring.points.push_back(startOf(triangles_, previousSide(ring.sides.back())));
  return true;
}

bool ShrinkingMesh::adjacent(uint32_t a, uint32_t b) const {
  const uint32_t first = first_side_[a];
  uint32_t side = first;
  do {
    const uint32_t last = previousSide(side);
    if (startOf(triangles_, nextSide(side)) == b || startOf(triangles_, last) == b) return true;
    side = opposite_[last];
  } while (side != first && side != kNone);
  return false;
}

bool ShrinkingMesh::keepsTopology(const Ring& ring, uint32_t target) const {
  const uint32_t count = ring.triangles(), to = ring.points[target];
  if (neighbours_[to] > kMostNeighbours) return false;
  if (!ring.closed && (count < 2 || (target > 0 && target < count))) return false;
  const auto outer = [&](uint32_t i) { return opposite_[nextSide(ring.sides[i])]; };
  if (count == (ring.closed ? 3 : 2)) {  // one triangle of the ring will be left
    bool lone = true;
    for (uint32_t i = 0; i < count; ++i) lone = lone && outer(i) == kNone;
    if (lone) return false;
  }
  if (ring.closed && count == 3) {  // it may lie on another triangle of the same corners
    const uint32_t beyond = outer(ring.next(target));
    if (beyond != kNone && startOf(triangles_, previousSide(beyond)) == to) return false;
  }
  for (uint32_t i = 0; i < ring.points.size(); ++i) {
    const bool beside = i == target || ring.next(i) == target || i == ring.next(target);
    if ((!beside || (!ring.closed && i + target == count)) && adjacent(to, ring.points[i]))
      return false;
  }
  return true;
}

void ShrinkingMesh::glue(uint32_t side, uint32_t other) {
  opposite_[side] = other;
  if (other != kNone) opposite_[other] = side;
}

/// Removes triangle i of the ring. Its neighbour `heir` in the ring is glued to what was beyond it.
void ShrinkingMesh::removeTriangle(const Ring& ring, uint32_t i, uint32_t heir) {
  const bool heir_follows = ring.next(i) == heir;
  const uint32_t lost = ring.sides[i] / 3;
  const uint32_t spoke =
      heir_follows ? ring.sides[heir] : previousSide(ring.sides[heir]);  // the side between the two
  glue(spoke, opposite_[nextSide(ring.sides[i])]);
  const uint32_t common = ring.points[heir_follows ? heir : i];
  if (first_side_[common] / 3 == lost) first_side_[common] = heir_follows ? nextSide(spoke) : spoke;
  --neighbours_[common];
  --triangle_count_;
}

void ShrinkingMesh::collapse(const Ring& ring, uint32_t target) {
  const uint32_t count = ring.triangles(), to = ring.points[target];
  const uint32_t before = (target + count - 1) % count;
  const bool loses_next = ring.closed || target == 0, loses_before = ring.closed || target == count;
  const uint32_t first = first_side_[to] / 3;
  if (loses_next && first == ring.sides[target] / 3)
    first_side_[to] = ring.sides[ring.next(target)];
  if (loses_before && first == ring.sides[before] / 3)
    first_side_[to] = ring.closed ? ring.sides[ring.next(target)] : ring.sides[0];
  if (loses_next) removeTriangle(ring, target, (target + 1) % count);
  if (loses_before) removeTriangle(ring, before, (before + count - 1) % count);
  for (const uint32_t side : ring.sides) triangles_[side / 3][side % 3] = to;
  neighbours_[to] += static_cast<uint32_t>(ring.points.size()) - (ring.closed ? 4 : 3);
  neighbours_[ring.centre] = 0;
}

}  // namespace tetrakis::inline remesh
