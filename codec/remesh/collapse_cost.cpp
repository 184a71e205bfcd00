// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/collapse_cost.hpp"

#include <algorithm>
#include <limits>

#include "codec/remesh/ring_flattening.hpp"

namespace tetrakis::inline remesh {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Weights of area times squared length: where triangles are to be even, and else.
constexpr double kEvenness = 1e-3, kLittleEvenness = 1e-6;
constexpr double kBoundary = 30;  // weight of the plane at a boundary edge, times squared length
constexpr double kSliver = 0.3;   // lower qualities of triangles are penalised
/// Triangles of this quality are refused, unless the ring has some that are nearly as thin already.
constexpr double kNoArea = 1e-6;
constexpr double kTurn = 0.2;        // least cosine between the normals before and after a collapse
constexpr uint32_t kNeighbours = 7;  // more neighbours than that are penalised

void addTriangle(const TriangleMesh& mesh, const Triangle& t, std::vector<Quadric>& quadrics) {
  const Point normal = areaNormal(mesh, t);
  const double doubled_area = length(normal);
  if (!(doubled_area > 0)) return;
  for (const uint32_t point : t)
    quadrics[point].addPlane(1 / doubled_area * normal, mesh.points[t[0]], doubled_area / 2);
}

/// Adds the plane through a boundary edge that is at right angles to the triangle of the edge.
void addBoundary(const TriangleMesh& mesh, uint32_t side, std::vector<Quadric>& quadrics) {
  const uint32_t a = startOf(mesh.triangles, side), b = startOf(mesh.triangles, nextSide(side));
  const Point edge = mesh.points[b] - mesh.points[a];
  const Point outwards = cross(edge, areaNormal(mesh, mesh.triangles[side / 3]));
  const double size = length(outwards);
  if (!(size > 0)) return;
  for (const uint32_t point : {a, b})
    quadrics[point].addPlane(1 / size * outwards, mesh.points[a], kBoundary * dot(edge, edge));
}

/// The quality of the triangle between the origin, a and b, whose area normal has the length
/// `size`: 1 if its sides are equal, 0 if it has no area.
double qualityOf(const Point& a, const Point& b, double size) {
  const Point c = b - a;
  return 2 * std::sqrt(3.0) * size / (dot(a, a) + dot(b, b) + dot(c, c));
}

}  // namespace

CollapseCost::CollapseCost(const TriangleMesh& mesh, DecimationAim aim)
    : points_(mesh.points), even_(aim == DecimationAim::kEven), quadrics_(mesh.points.size()) {
  for (const Triangle& t : mesh.triangles) addTriangle(mesh, t, quadrics_);
  const GluedSides glued = gluedSides(mesh.triangles);
  for (uint32_t side = 0; side < glued.opposite.size(); ++side) {
    if (glued.opposite[side] == kNone) addBoundary(mesh, side, quadrics_);
  }
}

/// A factor of at least 1. It is infinite if a triangle would turn over or lose its area.
double CollapseCost::shapePenalty(const Ring& ring, uint32_t target) const {
  double worst = kSliver;
  const Point& to = points_[ring.points[target]];
  for (uint32_t i = 0; i < ring.triangles(); ++i) {
    if (vanishes(ring, i, target)) continue;
    const Point a = points_[ring.points[i]] - to, b = points_[ring.points[ring.next(i)]] - to;
    const Point normal = cross(a, b), &old = normals_[i];
    const double size = length(normal), quality = qualityOf(a, b, size);
    if (!(quality > thinnest_)) return kInfinite;
    if (dot(normal, old) < kTurn * size * length(old)) return kInfinite;
    worst = std::min(worst, quality);
  }
  return even_ ? kSliver / worst : 1;
}

void CollapseCost::find(const ShrinkingMesh& shrinking, const Ring& ring,
                        std::vector<double>& costs) {
  const Point& centre = points_[ring.centre];
  normals_.resize(ring.triangles());
  thinnest_ = kNoArea;
  double area = 0;
  for (uint32_t i = 0; i < ring.triangles(); ++i) {
    const Point a = points_[ring.points[i]] - centre;
    const Point b = points_[ring.points[ring.next(i)]] - centre;
    normals_[i] = cross(a, b);
    const double size = length(normals_[i]);
    thinnest_ = std::min(thinnest_, qualityOf(a, b, size) / 2);
    area += size / 2;
  }
  costs.assign(ring.points.size(), kInfinite);
  const auto own = static_cast<uint32_t>(ring.points.size());
  for (uint32_t i = 0; i < own; ++i) {
    if (!ring.closed && i > 0 && i + 1 < own) continue;
    const uint32_t to = ring.points[i];
    const uint32_t neighbours = shrinking.neighbours(to) + own - (ring.closed ? 4 : 3);
    const Point way = points_[to] - centre;
    const double error = quadrics_[ring.centre].at(points_[to]);  // that of `to` itself isn't new
    const bool crowded = even_ && neighbours > kNeighbours;
    const double crowd = crowded ? 1.0 + (neighbours - kNeighbours) : 1.0;
    costs[i] = (error + (even_ ? kEvenness : kLittleEvenness) * area * dot(way, way)) * crowd *
               shapePenalty(ring, i);
  }
}

void CollapseCost::collapsed(const Ring& ring, uint32_t target) {
  quadrics_[ring.points[target]].add(quadrics_[ring.centre]);
}

}  // namespace tetrakis::inline remesh
